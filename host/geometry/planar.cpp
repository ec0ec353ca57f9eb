#include "host/geometry/planar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/geometry/rings.hpp"

namespace fencepost::host {

namespace {

template <class Visit>
void for_each_ring(const MultiPolygon& areas, Visit visit) {
  for (const Polygon& polygon : areas) {
    visit(polygon.outer);
    for (const LinearRing& hole : polygon.holes) visit(hole);
  }
}

double distance_to(Point p, const MultiPolygon& areas) {
  double nearest = HUGE_VAL;
  for_each_ring(areas, [&](const LinearRing& ring) { nearest = std::min(nearest, distance_to_outline(p, ring)); });
  return nearest;
}

double farthest(const MultiPolygon& from, const MultiPolygon& to, double step) {
  double worst = 0;
  for_each_ring(from, [&](const LinearRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      const int pieces = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / step)));
      for (int k = 0; k < pieces; ++k) {
        const double share = static_cast<double>(k) / pieces;
        worst = std::max(worst, distance_to({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}, to));
      }
    }
  });
  return worst;
}

}  // namespace

Polygon convex_hull(const MultiPolygon& areas) {
  LinearRing all;
  for_each_ring(areas, [&](const LinearRing& ring) { all.insert(all.end(), ring.begin(), ring.end()); });
  std::ranges::sort(all, [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  // The lower side from left to right, then the upper one back.
  LinearRing hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Point p : all) {
      const auto straight = [&](Point a, Point b) { return (b.x - a.x) * (p.y - a.y) <= (b.y - a.y) * (p.x - a.x); };
      while (hull.size() >= begin + 2 && straight(hull[hull.size() - 2], hull.back())) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::ranges::reverse(all);
  }
  return signed_area(hull) > 0 ? Polygon{std::move(hull), {}} : Polygon{};
}

std::optional<OutlineDistance> outline_distance(const MultiPolygon& a, const MultiPolygon& b, double step) {
  if (a.empty() || b.empty()) return std::nullopt;
  return OutlineDistance{farthest(a, b, step), farthest(b, a, step)};
}

}  // namespace fencepost::host
