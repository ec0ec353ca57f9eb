#include "host/models/sheaf.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::recon {
namespace {

std::size_t following(std::size_t i, std::size_t size) { return i + 1 == size ? 0 : i + 1; }
std::size_t preceding(std::size_t i, std::size_t size) { return i == 0 ? size - 1 : i - 1; }

// Chord between two unit bearings: 2 sin(angle / 2), in [0, 2].
float chord(const Vec2& a, const Vec2& b) { return (a - b).norm(); }

bool share_an_end(const SheafView& a, const SheafView& b) {
  return (a.left != Vec2{} && b.left != Vec2{}) || (a.right != Vec2{} && b.right != Vec2{});
}

// The ray from p along d meets the one from q along e.
bool meet(const Vec2& p, const Vec2& d, const Vec2& q, const Vec2& e, float least_sine, Vec2& post) {
  const float sine = cross(d, e);  // zero also for a censored end
  if (!(std::fabs(sine) >= least_sine)) return false;
  const Vec2 baseline = q - p;
  const float along_d = cross(baseline, e) / sine;
  const float along_e = cross(baseline, d) / sine;
  if (along_d < kPostNearest || along_e < kPostNearest) return false;
  post = p + along_d * d;
  return post.squared_norm() < kPostFarthest * kPostFarthest;
}

// Adds a point to a hull of at most two vertices.
std::size_t grow_line(std::span<Vec2> v, std::size_t size, const Vec2& point) {
  if (size == 0) {
    v[0] = point;
    return 1;
  }
  if (size == 1) {
    v[1] = point;
    return (point - v[0]).max_norm() > kHullTolerance ? 2 : 1;
  }
  const Vec2 along = v[1] - v[0];
  const float length_squared = along.squared_norm();
  const float height_times_base = cross(along, point - v[0]);
  if (!(height_times_base * height_times_base > kHullTolerance * kHullTolerance * length_squared)) {
    const float share = along.dot(point - v[0]) / length_squared;
    if (share < 0) v[0] = point;
    if (share > 1) v[1] = point;
    return 2;
  }
  v[2] = point;
  if (height_times_base < 0) std::swap(v[1], v[2]);
  return 3;
}

// The edges that a point outside sees: `count` of them from `first` on.
struct VisibleEdges {
  std::size_t first = 0;
  std::size_t count = 0;
};

// How far a point is from one edge, and on which side of its line.
struct EdgeView {
  float distance_squared = 0;  ///< to the edge itself, not to its line
  float outside_by = 0;        ///< times the edge's length
};

EdgeView view_of_edge(const Vec2& a, const Vec2& b, const Vec2& point) {
  const Vec2 along = b - a;
  const Vec2 offset = point - a;
  EdgeView view;
  view.outside_by = -cross(along, offset);
  const float share_times_square = along.dot(offset);
  const float length_squared = along.squared_norm();
  if (share_times_square > 0 && share_times_square < length_squared) {
    view.distance_squared = view.outside_by * view.outside_by / length_squared;
  } else {
    view.distance_squared = share_times_square > 0 ? (point - b).squared_norm() : offset.squared_norm();
  }
  return view;
}

// Posts of one view lie on one ray: many are almost in line, and a short edge is useless far along its line. Only the
// nearest edge and the run of visible ones around it are trusted.
VisibleEdges visible_from(std::span<const Vec2> v, std::size_t size, const Vec2& point) {
  std::size_t nearest = 0;
  EdgeView best = view_of_edge(v[0], v[following(0, size)], point);
  for (std::size_t i = 1; i < size; ++i) {
    const EdgeView view = view_of_edge(v[i], v[following(i, size)], point);
    const bool nearer = view.distance_squared < best.distance_squared;
    const bool same_vertex = view.distance_squared == best.distance_squared && view.outside_by > best.outside_by;
    if (!nearer && !same_vertex) continue;
    nearest = i;
    best = view;
  }
  if (!(best.distance_squared > kHullTolerance * kHullTolerance)) return {};
  if (!(best.outside_by > 0)) return {};
  const auto sees = [&](std::size_t i) { return -cross(v[following(i, size)] - v[i], point - v[i]) > 0; };
  VisibleEdges visible{nearest, 1};
  std::size_t last = nearest;
  for (; visible.count + 1 < size && sees(following(last, size)); ++visible.count) last = following(last, size);
  for (; visible.count + 1 < size && sees(preceding(visible.first, size)); ++visible.count) {
    visible.first = preceding(visible.first, size);
  }
  return visible;
}

// The vertex nearest to the line through its neighbours.
std::size_t least_vertex(std::span<const Vec2> v, std::size_t size) {
  std::size_t least = 0;
  float least_height = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Vec2& before = v[preceding(i, size)];
    const Vec2 base = v[following(i, size)] - before;
    const float height_times_base = cross(base, v[i] - before);
    const float height = height_times_base * height_times_base / base.squared_norm();
    if (i > 0 && !(height < least_height)) continue;
    least = i;
    least_height = height;
  }
  return least;
}

// The mean of the two middle ones for an even number, so that a mirrored scene has mirrored medians.
float median(std::span<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 != 0) return *middle;
  return 0.5F * (*std::max_element(values.begin(), middle) + *middle);
}

template <class Visit>
void for_each_post(std::span<SheafPlane> planes, Visit visit) {
  for (SheafPlane& plane : planes) {
    if (plane.has_left) visit(plane.left, plane.has_left);
    if (plane.has_right) visit(plane.right, plane.has_right);
  }
}

}  // namespace

SheafView sheaf_view(const Sighting& sighting, MapPoint origin) {
  SheafView view{sighting.lens_from(origin), sighting.center};
  if (is_edge(sighting.left.end)) view.left = sighting.left.direction;
  if (is_edge(sighting.right.end)) view.right = sighting.right.direction;
  return view;
}

bool repeats(const SheafView& view, const SheafView& other) {
  return (view.bearing - other.bearing).squared_norm() < kParallaxLeast * kParallaxLeast;
}

SheafPlane sheaf_plane(const SheafView& a, const SheafView& b, float least_sine) {
  SheafPlane plane;
  plane.has_left = meet(a.lens, a.left, b.lens, b.left, least_sine, plane.left);
  plane.has_right = meet(a.lens, a.right, b.lens, b.right, least_sine, plane.right);
  return plane;
}

std::size_t sheaf_partner(std::span<const SheafView> views, std::size_t i) {
  std::size_t best = views.size();
  float best_off = 0;
  for (std::size_t j = 0; j < views.size(); ++j) {
    if (j == i || !share_an_end(views[i], views[j])) continue;
    const float parallax = chord(views[i].bearing, views[j].bearing);
    if (!(parallax > kParallaxLeast) || !(parallax < kParallaxMost)) continue;
    float off = std::fabs(parallax - kParallaxWanted);
    if (j < i) off += kParallaxLeast;
    if (best != views.size() && !(off < best_off)) continue;
    best = j;
    best_off = off;
  }
  return best;
}

std::size_t grow_hull(std::span<Vec2> v, std::size_t size, const Vec2& point) {
  if (size < 3) return grow_line(v, size, point);
  const VisibleEdges visible = visible_from(v, size, point);
  if (visible.count == 0) return size;
  // The vertices between the visible edges go, the point comes in their place.
  const auto begin = v.begin();
  const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
  std::rotate(begin, at(visible.first), at(size));
  if (visible.count == 1) {
    std::copy_backward(at(1), at(size), at(size + 1));
  } else {
    std::copy(at(visible.count), at(size), at(2));
  }
  v[1] = point;
  const std::size_t grown = size - visible.count + 2;
  if (grown < v.size()) return grown;
  const std::size_t lost = least_vertex(v, grown);
  std::copy(at(lost + 1), at(grown), at(lost));
  return grown - 1;
}

void trim_posts(std::span<SheafPlane> planes, const Vec2& axis, std::span<float> scratch) {
  std::size_t count = 0;
  const auto median_of = [&](auto value) {
    count = 0;
    for_each_post(planes, [&](const Vec2& post, bool) { scratch[count++] = value(post); });
    return count == 0 ? 0.0F : median(scratch.first(count));
  };
  const float along = median_of([&](const Vec2& post) { return axis.dot(post); });
  if (count < kTrimPosts) return;
  const float across = median_of([&](const Vec2& post) { return cross(axis, post); });
  const Vec2 center = along * axis + across * left_of(axis);
  const auto radius = [&](const Vec2& post) { return (post - center).norm(); };
  const float farthest = kTrimRadii * median_of(radius);
  for_each_post(planes, [&](const Vec2& post, bool& has) { has = radius(post) <= farthest; });
}

std::string_view name(SheafRefusal refusal) {
  switch (refusal) {
    case SheafRefusal::kNone: return "";
    case SheafRefusal::kNoEdges: return "only censored ends seen";
    case SheafRefusal::kNoCrossing: return "no edges of two views cross";
    case SheafRefusal::kFewPosts: return "fewer than three posts";
    case SheafRefusal::kOneLine: return "all posts on one line";
  }
  return "";
}

}  // namespace fencepost::recon
