#include "host/simulate/prism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fencepost::host {

namespace {

/// Nothing nearer than this is seen, m: a lens cap's distance; keeps 1/s finite.
constexpr double kNear = 1e-3;

std::vector<Point> ring_in_camera(const LinearRing& ring, const CameraPose& camera) {
  const double c = std::cos(camera.heading);
  const double s = std::sin(camera.heading);
  std::vector<Point> local;
  local.reserve(ring.size());
  for (const Point p : ring) {
    const double dx = p.x - camera.x;
    const double dy = p.y - camera.y;
    local.push_back({c * dx + s * dy, -s * dx + c * dy});
  }
  return local;
}

/// Sutherland-Hodgman against x >= kNear. Bridges of a ring that is cut in two run along the plane and cancel in
/// pairs under the even-odd rule.
std::vector<Point> ahead_of_camera(const std::vector<Point>& ring) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    if (a.x >= kNear) kept.push_back(a);
    if ((a.x >= kNear) != (b.x >= kNear)) {
      kept.push_back({kNear, a.y + (b.y - a.y) * (kNear - a.x) / (b.x - a.x)});
    }
  }
  return kept;
}

}  // namespace

Prism::Prism(const SceneObject& object, const CameraPose& camera)
    : bottom_(object.base - camera.z),
      top_(object.base + object.height_m - camera.z),
      nearest_(std::numeric_limits<double>::infinity()),
      across_min_(std::numeric_limits<double>::infinity()),
      across_max_(-std::numeric_limits<double>::infinity()) {
  add_ring(ahead_of_camera(ring_in_camera(object.footprint.outer, camera)));
  for (const LinearRing& hole : object.footprint.holes) add_ring(ahead_of_camera(ring_in_camera(hole, camera)));
  if (!edges_.empty()) bound_rise();
}

void Prism::add_ring(const std::vector<Point>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Point a = ring[i];
    Point b = ring[(i + 1) % ring.size()];
    double across_a = -a.y / a.x;
    double across_b = -b.y / b.x;
    nearest_ = std::min(nearest_, a.x);
    farthest_ = std::max(farthest_, a.x);
    if (across_a > across_b) {
      std::swap(a, b);
      std::swap(across_a, across_b);
    }
    across_min_ = std::min(across_min_, across_a);
    across_max_ = std::max(across_max_, across_b);
    if (across_a == across_b) continue;  // seen end on: its neighbours carry the crossing
    edges_.push_back({across_a, across_b, 1 / a.x, (1 / b.x - 1 / a.x) / (across_b - across_a)});
  }
}

void Prism::sort_into_slabs() const {
  for (const Edge& edge : edges_) {
    breaks_.push_back(edge.low);
    breaks_.push_back(edge.high);
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
  // Counted, then filled: edge e is active in the slabs [first, last).
  const auto slab_at = [&](double across) {
    return static_cast<std::size_t>(std::lower_bound(breaks_.begin(), breaks_.end(), across) - breaks_.begin());
  };
  slab_begin_.assign(breaks_.size() + 1, 0);
  for (const Edge& edge : edges_) {
    const std::size_t last = slab_at(edge.high);
    for (std::size_t i = slab_at(edge.low); i < last; ++i) ++slab_begin_[i + 1];
  }
  for (std::size_t i = 0; i < breaks_.size(); ++i) slab_begin_[i + 1] += slab_begin_[i];
  active_.resize(slab_begin_.back());
  std::vector<std::size_t> next(slab_begin_.begin(), slab_begin_.end() - 1);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const std::size_t last = slab_at(edges_[e].high);
    for (std::size_t i = slab_at(edges_[e].low); i < last; ++i) active_[next[i]++] = e;
  }
}

void Prism::bound_rise() {
  rise_min_ = std::min(bottom_ / nearest_, bottom_ / farthest_);
  rise_max_ = std::max(top_ / nearest_, top_ / farthest_);
}

void Prism::stretches(double across, std::vector<Stretch>& out) const {
  out.clear();
  if (breaks_.empty()) sort_into_slabs();
  const auto above = std::upper_bound(breaks_.begin(), breaks_.end(), across);
  if (above == breaks_.begin() || above == breaks_.end()) return;
  const auto slab = static_cast<std::size_t>(above - breaks_.begin()) - 1;
  const std::size_t begin = slab_begin_[slab];
  const std::size_t count = slab_begin_[slab + 1] - begin;
  const auto crossing = [&](std::size_t i) { return edges_[active_[begin + i]].crossing(across); };
  if (count == 2) {
    const double a = crossing(0);
    const double b = crossing(1);
    out.push_back({std::min(a, b), std::max(a, b)});
    return;
  }
  std::vector<double> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = crossing(i);
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + 1 < count; i += 2) out.push_back({all[i], all[i + 1]});
}

double Prism::first_hit(const Stretch& stretch, double rise) const {
  const double at_entry = rise * stretch.enter;
  if (at_entry >= bottom_ && at_entry <= top_) return stretch.enter;
  // Through the lid from above, or through the underside of something that hovers.
  const double face = at_entry > top_ ? top_ : bottom_;
  const bool towards = at_entry > top_ ? rise < 0 : rise > 0;
  if (!towards) return -1;
  const double hit = face / rise;
  return hit <= stretch.leave ? hit : -1;
}

}  // namespace fencepost::host
