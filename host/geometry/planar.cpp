#include "host/geometry/planar.hpp"

#include <algorithm>
#include <cmath>

#include "host/geometry/geos_session.hpp"
#include "host/geometry/rings.hpp"

namespace fencepost::host {

namespace {

using Operation = GEOSGeometry* (*)(GEOSContextHandle_t, const GEOSGeometry*, const GEOSGeometry*);

MultiPolygon combined(Operation operation, const MultiPolygon& a, const MultiPolygon& b) {
  GeosSession geos;
  const auto left = geos.to_geos(a);
  const auto right = geos.to_geos(b);
  return geos.from_geos(geos.own(operation(geos.handle(), left.get(), right.get())).get());
}

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

MultiPolygon intersection(const MultiPolygon& a, const MultiPolygon& b) { return combined(&GEOSIntersection_r, a, b); }
MultiPolygon unite(const MultiPolygon& a, const MultiPolygon& b) { return combined(&GEOSUnion_r, a, b); }
MultiPolygon difference(const MultiPolygon& a, const MultiPolygon& b) { return combined(&GEOSDifference_r, a, b); }

double intersection_area(const MultiPolygon& a, const MultiPolygon& b) { return area(intersection(a, b)); }
double union_area(const MultiPolygon& a, const MultiPolygon& b) { return area(unite(a, b)); }
double difference_area(const MultiPolygon& a, const MultiPolygon& b) { return area(difference(a, b)); }

std::optional<Invalidity> find_invalidity(const Polygon& polygon) {
  if (polygon.outer.size() < 3) {
    return Invalidity{"Too few points", polygon.outer.empty() ? Point{} : polygon.outer.front()};
  }
  GeosSession geos;
  const auto geometry = geos.to_geos(polygon);
  char* reason = nullptr;
  GEOSGeometry* place = nullptr;
  const char valid = GEOSisValidDetail_r(geos.handle(), geometry.get(), 0, &reason, &place);
  std::optional<Invalidity> result;
  if (valid != 1) {
    result.emplace();
    if (reason != nullptr) result->reason = reason;
    if (place != nullptr) {
      GEOSGeomGetX_r(geos.handle(), place, &result->where.x);
      GEOSGeomGetY_r(geos.handle(), place, &result->where.y);
    }
  } else if (!(area(polygon) > 0)) {
    result = Invalidity{"No area", polygon.outer.front()};
  }
  if (reason != nullptr) GEOSFree_r(geos.handle(), reason);
  if (place != nullptr) GEOSGeom_destroy_r(geos.handle(), place);
  return result;
}

Polygon convex_hull(const MultiPolygon& areas) {
  GeosSession geos;
  const auto geometry = geos.to_geos(areas);
  const MultiPolygon hull = geos.from_geos(geos.own(GEOSConvexHull_r(geos.handle(), geometry.get())).get());
  return hull.empty() ? Polygon{} : hull.front();
}

std::vector<Triangle> triangulation(const MultiPolygon& areas) {
  GeosSession geos;
  const auto geometry = geos.to_geos(areas);
  const auto pieces = geos.own(GEOSConstrainedDelaunayTriangulation_r(geos.handle(), geometry.get()));
  std::vector<Triangle> triangles;
  for (const Polygon& piece : geos.from_geos(pieces.get())) {
    triangles.push_back({piece.outer[0], piece.outer[1], piece.outer[2]});
  }
  return triangles;
}

std::optional<OutlineDistance> outline_distance(const MultiPolygon& a, const MultiPolygon& b, double step) {
  if (a.empty() || b.empty()) return std::nullopt;
  return OutlineDistance{farthest(a, b, step), farthest(b, a, step)};
}

}  // namespace fencepost::host
