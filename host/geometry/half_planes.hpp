// Intersection of half planes and viewing wedges in double: the test oracle of the robot's carving and clipping.
#pragma once

#include <span>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// All p with normal . p <= offset.
struct HalfPlane {
  Point normal;
  double offset = 0;
};

/// `convex` (counter-clockwise) cut by one half plane; empty when nothing is left.
LinearRing clipped(const LinearRing& convex, const HalfPlane& keep);

/// `start` cut by all of them.
LinearRing clipped(LinearRing start, std::span<const HalfPlane> keep);

/// Counter-clockwise square of side `side`, metres.
LinearRing square(Point center, double side);

/// The region consistent with a view: in front of `apex`, between the bearings `right` and `left` (rad, map frame,
/// left - right in (0, pi)).
struct Wedge {
  Point apex;
  double right = 0;
  double left = 0;
};
/// Everything to the left of the wedge's right ray, and to the right of its left ray.
HalfPlane right_bound(const Wedge& wedge);
HalfPlane left_bound(const Wedge& wedge);

/// `start` cut by both bounds of every wedge.
LinearRing intersect_wedges(LinearRing start, std::span<const Wedge> wedges);

}  // namespace fencepost::host
