#include "firmware/recon/clip.hpp"

#include "hal/base/check.hpp"

namespace fencepost::recon {
namespace {

float outside_by(const HalfPlane& half_plane, const Vec2& point) {
  return half_plane.normal.dot(point) - half_plane.bound;
}

std::size_t next(std::size_t i, std::size_t size) { return i + 1 == size ? 0 : i + 1; }
std::size_t previous(std::size_t i, std::size_t size) { return i == 0 ? size - 1 : i - 1; }

Vec2 crossing(const Vec2& inside, float d_inside, const Vec2& outside, float d_outside) {
  // d_inside <= 0 < d_outside: the share of the way from inside to outside is in [0, 1).
  const float share = d_inside / (d_inside - d_outside);
  return inside + share * (outside - inside);
}

// Where edge i grows to when it is given up: the meeting point of its neighbours. False if they do not meet outside.
bool apex_over_edge(std::span<const Vec2> v, std::size_t size, std::size_t i, Vec2& apex, float& added_area) {
  const Vec2& a = v[i];
  const Vec2& b = v[next(i, size)];
  const Vec2 along_previous = a - v[previous(i, size)];
  const Vec2 along_next = b - v[next(next(i, size), size)];
  const float turn = cross(along_previous, along_next);
  if (!(turn > 0)) return false;
  const float share = cross(b - a, along_next) / turn;
  apex = a + share * along_previous;
  added_area = 0.5F * cross(apex - a, b - a);
  if (added_area < 0) added_area = -added_area;
  return share >= 0;
}

// Gives up the edge that costs the least area. Returns the new size; unchanged if no edge can go.
std::size_t simplify(std::span<Vec2> v, std::size_t size) {
  std::size_t best = size;
  Vec2 best_apex{0, 0};
  float best_area = 0;
  for (std::size_t i = 0; i < size; ++i) {
    Vec2 apex{0, 0};
    float area = 0;
    if (!apex_over_edge(v, size, i, apex, area)) continue;
    if (best == size || area < best_area) {
      best = i;
      best_apex = apex;
      best_area = area;
    }
  }
  if (best == size) return size;
  v[best] = best_apex;
  for (std::size_t i = next(best, size); i + 1 < size && i != 0; ++i) v[i] = v[i + 1];
  if (best + 1 == size) {  // the edge from the last vertex to the first: the first one goes
    for (std::size_t i = 0; i + 1 < size; ++i) v[i] = v[i + 1];
  }
  return size - 1;
}

}  // namespace

std::size_t clip_convex(std::span<Vec2> v, std::size_t size, const HalfPlane& half_plane) {
  if (size < 3) return 0;
  std::size_t outside = 0;
  std::size_t first_out = size;  // the first outside vertex after an inside one
  std::size_t first_in = size;   // the first inside vertex after an outside one
  bool previous_out = outside_by(half_plane, v[size - 1]) > kShallowestCut;
  for (std::size_t i = 0; i < size; ++i) {
    const bool out = outside_by(half_plane, v[i]) > kShallowestCut;
    if (out) ++outside;
    if (out && !previous_out) first_out = i;
    if (!out && previous_out) first_in = i;
    previous_out = out;
  }
  if (outside == 0) return size;
  if (outside == size) return 0;
  if (first_out == size || first_in == size) return size;
  if (size - outside + 2 > v.size()) {
    const std::size_t smaller = simplify(v, size);
    return smaller == size ? size : clip_convex(v, smaller, half_plane);  // one level: the room is there now
  }
  const std::size_t last_in = previous(first_out, size);
  const std::size_t last_out = previous(first_in, size);
  const auto side = [&](std::size_t i) { return outside_by(half_plane, v[i]); };
  const auto at_most_zero = [](float d) { return d < 0 ? d : 0.0F; };
  const Vec2 leaving = crossing(v[last_in], at_most_zero(side(last_in)), v[first_out], side(first_out));
  const Vec2 entering = crossing(v[first_in], at_most_zero(side(first_in)), v[last_out], side(last_out));
  if (first_out < first_in) {
    // inside 0..last_in, outside first_out..last_out, inside first_in..
    const std::size_t tail = size - first_in;
    const std::size_t to = first_out + 2;
    if (to <= first_in) {
      for (std::size_t i = 0; i < tail; ++i) v[to + i] = v[first_in + i];
    } else {
      for (std::size_t i = tail; i-- > 0;) v[to + i] = v[first_in + i];
    }
    v[first_out] = leaving;
    v[first_out + 1] = entering;
    return to + tail;
  }
  // outside wraps over the end: inside first_in..last_in only (or first_in == 0)
  const std::size_t kept = last_in - first_in + 1;
  for (std::size_t i = 0; i < kept; ++i) v[i] = v[first_in + i];
  FENCEPOST_CHECK(kept + 2 <= v.size());
  v[kept] = leaving;
  v[kept + 1] = entering;
  return kept + 2;
}

Bounds bounds_of(std::span<const Vec2> vertices) {
  if (vertices.empty()) return {};
  Bounds bounds{vertices[0], vertices[0]};
  for (const Vec2& v : vertices) {
    bounds.low = bounds.low.cwiseMin(v);
    bounds.high = bounds.high.cwiseMax(v);
  }
  return bounds;
}

}  // namespace fencepost::recon
