// Rings: orientation, closing, circles, rigid motion. No library behind it.
#pragma once

#include <span>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// Shoelace area, m^2; positive when counter-clockwise.
double signed_area(std::span<const Point> ring);

/// Area in m^2, holes taken out. Rings may have either orientation.
double area(const Polygon& polygon);
double area(const MultiPolygon& areas);

/// Outer ring counter-clockwise, holes clockwise (RFC 7946), starting vertex kept.
Polygon oriented(Polygon polygon);

/// GeoJSON repeats the first vertex at the end; our rings do not.
LinearRing opened(LinearRing ring);
LinearRing closed(LinearRing ring);

/// Regular polygon with the *area* of the circle (its vertices lie just outside), first vertex at angle 0,
/// counter-clockwise. `vertices` >= 3.
LinearRing circle_ring(Point center, double radius, int vertices = 256);

/// The circle that `circle_ring` would turn into `ring`, if there is one within 1 nm; used when writing scenes.
bool is_circle_ring(std::span<const Point> ring, Point& center, double& radius);

/// Rotated by `angle` (rad, about the origin), then moved.
Polygon moved(Polygon polygon, double angle, Point shift);

/// Smallest distance from `p` to the ring's line, metres.
double distance_to_outline(Point p, std::span<const Point> ring);

/// Even-odd rule; points on the line may go either way.
bool contains(const Polygon& polygon, Point p);

}  // namespace fencepost::host
