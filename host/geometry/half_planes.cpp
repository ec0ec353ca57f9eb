#include "host/geometry/half_planes.hpp"

#include <cmath>

namespace fencepost::host {

namespace {

double excess(const HalfPlane& plane, Point p) { return plane.normal.x * p.x + plane.normal.y * p.y - plane.offset; }

}  // namespace

LinearRing clipped(const LinearRing& convex, const HalfPlane& keep) {
  LinearRing result;
  result.reserve(convex.size() + 1);
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Point a = convex[i];
    const Point b = convex[(i + 1) % convex.size()];
    const double at_a = excess(keep, a);
    const double at_b = excess(keep, b);
    if (at_a <= 0) result.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const double share = at_a / (at_a - at_b);
      result.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
  }
  if (result.size() < 3) result.clear();
  return result;
}

LinearRing clipped(LinearRing start, std::span<const HalfPlane> keep) {
  for (const HalfPlane& plane : keep) start = clipped(start, plane);
  return start;
}

LinearRing square(Point center, double side) {
  const double h = side / 2;
  return {{center.x - h, center.y - h},
          {center.x + h, center.y - h},
          {center.x + h, center.y + h},
          {center.x - h, center.y + h}};
}

HalfPlane right_bound(const Wedge& wedge) {
  const Point outward{std::sin(wedge.right), -std::cos(wedge.right)};
  return {outward, outward.x * wedge.apex.x + outward.y * wedge.apex.y};
}

HalfPlane left_bound(const Wedge& wedge) {
  const Point outward{-std::sin(wedge.left), std::cos(wedge.left)};
  return {outward, outward.x * wedge.apex.x + outward.y * wedge.apex.y};
}

LinearRing intersect_wedges(LinearRing start, std::span<const Wedge> wedges) {
  for (const Wedge& wedge : wedges) {
    start = clipped(start, right_bound(wedge));
    start = clipped(start, left_bound(wedge));
  }
  return start;
}

}  // namespace fencepost::host
