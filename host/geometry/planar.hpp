// Measures of planar areas: common area of two, validity of outlines, triangles, distances. No library behind it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/geometry/rings.hpp"

namespace fencepost::host {

/// How much two areas cover, m^2. A polygon covers what its rings enclose an odd number of times; several polygons of
/// one input count once where they overlap. Coordinates are finite.
struct Overlap {
  double both = 0;
  double only_a = 0;
  double only_b = 0;
};
/// Exact but for rounding. Cost: all pairs of edges that share a height.
Overlap overlap(const MultiPolygon& a, const MultiPolygon& b);

double intersection_area(const MultiPolygon& a, const MultiPolygon& b);
double union_area(const MultiPolygon& a, const MultiPolygon& b);
double difference_area(const MultiPolygon& a, const MultiPolygon& b);

/// Why a polygon is not one, and where.
struct Invalidity {
  std::string reason;  ///< "Self-intersection", "Hole lies outside shell", "Too few points", ...
  Point where;
};
/// Nothing when the polygon is valid as GeoJSON has it: simple rings, some area, an interior in one piece.
/// Holes lie inside and meet other rings in single points.
std::optional<Invalidity> find_invalidity(const Polygon& polygon);

/// Counter-clockwise; an empty outer ring when the input spans no area.
Polygon convex_hull(const MultiPolygon& areas);

using Triangle = std::array<Point, 3>;  ///< counter-clockwise
/// Each polygon as triangles whose corners are vertices of its rings, holes left out. One that is not valid gives
/// triangles that cover about the same.
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
