#include "host/evaluate/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"

namespace fencepost::host {
namespace {

bool is_finite(const LinearRing& ring) {
  return std::all_of(ring.begin(), ring.end(), [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

bool is_finite(const MultiPolygon& areas) {
  return std::all_of(areas.begin(), areas.end(), [](const Polygon& polygon) {
    return is_finite(polygon.outer) && std::all_of(polygon.holes.begin(), polygon.holes.end(),
                                                   [](const LinearRing& hole) { return is_finite(hole); });
  });
}

/// Area, and area times centroid relative to `base` (near the ring, for precision).
struct Moments {
  double area = 0;
  double x = 0;
  double y = 0;
};

Moments moments(const LinearRing& ring, Point base) {
  Moments sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a{ring[i].x - base.x, ring[i].y - base.y};
    const Point next = ring[(i + 1) % ring.size()];
    const Point b{next.x - base.x, next.y - base.y};
    const double cross = a.x * b.y - b.x * a.y;
    sum.area += cross / 2;
    sum.x += (a.x + b.x) * cross / 6;
    sum.y += (a.y + b.y) * cross / 6;
  }
  if (sum.area < 0) sum = {-sum.area, -sum.x, -sum.y};
  return sum;
}

}  // namespace

Score score(const MultiPolygon& model, const Polygon& footprint) {
  if (!is_finite(model)) return kEmptyScore;
  const Overlap found = overlap(model, {footprint});
  const double model_area = found.both + found.only_a;
  const double true_area = found.both + found.only_b;
  if (model_area < kNoArea) return kEmptyScore;
  if (true_area < kNoArea) return {};
  const auto share = [](double part, double whole) { return std::clamp(part / whole, 0.0, 1.0); };
  return {1 - share(found.both, true_area), 1 - share(found.both, model_area),
          share(found.both, model_area + found.only_b), false};
}

Point centroid(const Polygon& polygon) {
  if (polygon.outer.empty()) return {};
  const Point base = polygon.outer.front();
  Moments sum = moments(polygon.outer, base);
  for (const LinearRing& hole : polygon.holes) {
    const Moments out = moments(hole, base);
    sum = {sum.area - out.area, sum.x - out.x, sum.y - out.y};
  }
  if (sum.area <= 0) return base;
  return {base.x + sum.x / sum.area, base.y + sum.y / sum.area};
}

double circumscribed_radius(const Polygon& polygon) {
  const Point center = centroid(polygon);
  double radius = 0;
  for (const Point p : polygon.outer) radius = std::max(radius, std::hypot(p.x - center.x, p.y - center.y));
  return radius;
}

}  // namespace fencepost::host
