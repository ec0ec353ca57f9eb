// Plain polygon types of the desk: map frame, metres, double.
#pragma once

#include <vector>

namespace fencepost::host {

struct Point {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Closed implicitly: the first vertex is not repeated at the end.
using LinearRing = std::vector<Point>;

/// From its first vertex to its last.
using Polyline = std::vector<Point>;

/// Outer ring counter-clockwise, holes clockwise.
struct Polygon {
  LinearRing outer;
  std::vector<LinearRing> holes;
};

/// Empty: nothing.
using MultiPolygon = std::vector<Polygon>;

}  // namespace fencepost::host
