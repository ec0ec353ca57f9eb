#include "host/geometry/rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace fencepost::host {

namespace {

double distance_to_segment(Point p, Point a, Point b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  double along = 0;
  if (length2 > 0) along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0);
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// Radius of the vertices of a regular polygon over the radius of the circle of equal area.
double circumradius_factor(int vertices) {
  const double step = 2 * std::numbers::pi / vertices;
  return std::sqrt(step / std::sin(step));
}

LinearRing with_orientation(LinearRing ring, bool counter_clockwise) {
  if ((signed_area(ring) < 0) == counter_clockwise && ring.size() > 1) std::reverse(ring.begin() + 1, ring.end());
  return ring;
}

}  // namespace

double signed_area(std::span<const Point> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // Relative to the first vertex: far from the origin the products would cancel badly.
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    twice += (a.x - ring[0].x) * (b.y - ring[0].y) - (a.y - ring[0].y) * (b.x - ring[0].x);
  }
  return twice / 2;
}

double area(const Polygon& polygon) {
  double total = std::abs(signed_area(polygon.outer));
  for (const LinearRing& hole : polygon.holes) total -= std::abs(signed_area(hole));
  return total;
}

double area(const MultiPolygon& areas) {
  double total = 0;
  for (const Polygon& polygon : areas) total += area(polygon);
  return total;
}

Polygon oriented(Polygon polygon) {
  polygon.outer = with_orientation(std::move(polygon.outer), true);
  for (LinearRing& hole : polygon.holes) hole = with_orientation(std::move(hole), false);
  return polygon;
}

LinearRing opened(LinearRing ring) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

LinearRing closed(LinearRing ring) {
  if (!ring.empty() && (ring.size() == 1 || !(ring.front() == ring.back()))) ring.push_back(ring.front());
  return ring;
}

LinearRing circle_ring(Point center, double radius, int vertices) {
  const double vertex_radius = radius * circumradius_factor(vertices);
  LinearRing ring;
  ring.reserve(static_cast<std::size_t>(vertices));
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2 * std::numbers::pi * i / vertices;
    ring.push_back({center.x + vertex_radius * std::cos(angle), center.y + vertex_radius * std::sin(angle)});
  }
  return ring;
}

bool is_circle_ring(std::span<const Point> ring, Point& center, double& radius) {
  constexpr std::size_t kFewest = 32;  // below that the user meant a polygon
  constexpr double kTolerance = 1e-9;  // m
  if (ring.size() < kFewest) return false;
  Point sum;
  for (const Point p : ring) sum = {sum.x + p.x, sum.y + p.y};
  const auto count = static_cast<double>(ring.size());
  center = {sum.x / count, sum.y / count};
  const int vertices = static_cast<int>(ring.size());
  radius = std::hypot(ring[0].x - center.x, ring[0].y - center.y) / circumradius_factor(vertices);
  const LinearRing ideal = circle_ring(center, radius, vertices);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (std::hypot(ring[i].x - ideal[i].x, ring[i].y - ideal[i].y) > kTolerance) return false;
  }
  return true;
}

Polygon moved(Polygon polygon, double angle, Point shift) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto move = [&](LinearRing& ring) {
    for (Point& p : ring) p = {c * p.x - s * p.y + shift.x, s * p.x + c * p.y + shift.y};
  };
  move(polygon.outer);
  for (LinearRing& hole : polygon.holes) move(hole);
  return polygon;
}

double distance_to_outline(Point p, std::span<const Point> ring) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    nearest = std::min(nearest, distance_to_segment(p, ring[i], ring[(i + 1) % ring.size()]));
  }
  return nearest;
}

bool contains(const Polygon& polygon, Point p) {
  bool inside = false;
  const auto cross = [&](const LinearRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
    }
  };
  cross(polygon.outer);
  for (const LinearRing& hole : polygon.holes) cross(hole);
  return inside;
}

}  // namespace fencepost::host
