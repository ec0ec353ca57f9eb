// Exact-as-double set operations on planar areas. Backed by GEOS; no GEOS type leaves the .cpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/geometry/rings.hpp"

namespace fencepost::host {

/// The parts that both cover, that either covers, that only `a` covers. Rings come back oriented (outer
/// counter-clockwise). Inputs that are not valid are repaired first; slivers without area vanish.
MultiPolygon intersection(const MultiPolygon& a, const MultiPolygon& b);
MultiPolygon unite(const MultiPolygon& a, const MultiPolygon& b);
MultiPolygon difference(const MultiPolygon& a, const MultiPolygon& b);

double intersection_area(const MultiPolygon& a, const MultiPolygon& b);
double union_area(const MultiPolygon& a, const MultiPolygon& b);
double difference_area(const MultiPolygon& a, const MultiPolygon& b);

/// Why a polygon is not one, and where.
struct Invalidity {
  std::string reason;  ///< "Self-intersection", "Hole lies outside shell", "Too few points", ...
  Point where;
};
/// Nothing when the polygon is valid (simple rings, holes inside, some area).
std::optional<Invalidity> find_invalidity(const Polygon& polygon);

/// Counter-clockwise; an empty outer ring when the input spans no area.
Polygon convex_hull(const MultiPolygon& areas);

using Triangle = std::array<Point, 3>;  ///< counter-clockwise
/// The area as triangles whose corners are vertices of its rings, holes left out (constrained Delaunay).
std::vector<Triangle> triangulation(const MultiPolygon& areas);

/// How far two outlines lie apart: the largest distance from a point of one to the other, each way, metres.
struct OutlineDistance {
  double from_a = 0;
  double from_b = 0;
  [[nodiscard]] double hausdorff() const { return from_a > from_b ? from_a : from_b; }
};
/// Outlines are sampled every `step` metres (error at most step / 2); nothing when either is empty.
std::optional<OutlineDistance> outline_distance(const MultiPolygon& a, const MultiPolygon& b, double step = 5e-4);

}  // namespace fencepost::host
