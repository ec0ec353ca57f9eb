// Ear clipping: holes are joined to the outer ring by bridges, then corner after corner is cut off.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "host/geometry/planar.hpp"

namespace fencepost::host {
namespace {

double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// On its border, too.
bool in_triangle(Point p, Point a, Point b, Point c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

Point before(const LinearRing& ring, std::size_t i) { return ring[(i + ring.size() - 1) % ring.size()]; }
Point after(const LinearRing& ring, std::size_t i) { return ring[(i + 1) % ring.size()]; }

/// Whether the way from a vertex to `p` begins inside the ring.
bool faces(const LinearRing& ring, std::size_t i, Point p) {
  const bool left_in = turn(before(ring, i), ring[i], p) >= 0;
  const bool left_out = turn(ring[i], after(ring, i), p) >= 0;
  return turn(before(ring, i), ring[i], after(ring, i)) > 0 ? left_in && left_out : left_in || left_out;
}

/// The vertex of `ring` (counter-clockwise) that `from`, inside it, sees; to the right, where its nearest side is.
std::size_t visible_vertex(const LinearRing& ring, Point from) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t found = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = after(ring, i);
    if (!(a.y <= from.y && b.y >= from.y) || a.y == b.y) continue;  // solid is to the left of sides that rise
    const double x = a.x + (b.x - a.x) * (from.y - a.y) / (b.y - a.y);
    if (x < from.x || x >= nearest) continue;
    nearest = x;
    found = a.x > b.x ? i : (i + 1) % ring.size();
  }
  if (std::isinf(nearest)) return found;
  // Other corners may hide it; then the one that is least off the straight line is in sight, of several the nearest.
  const Point hit{nearest, from.y};
  const Point corner = ring[found];
  const auto rank = [&](Point p) { return std::pair(std::abs(p.y - from.y) / std::max(p.x - from.x, 1e-300), p.x); };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point p = ring[i];
    if (p == corner || p.x < from.x || p.x > corner.x || turn(before(ring, i), p, after(ring, i)) > 0) continue;
    const bool hides = corner.y < from.y ? in_triangle(p, from, corner, hit) : in_triangle(p, from, hit, corner);
    if (hides && (ring[found] == corner || rank(p) < rank(ring[found]))) found = i;
  }
  // A bridge passes a vertex twice: the one whose angle has `from` in it.
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] == ring[found] && faces(ring, i, from)) return i;
  }
  return found;
}

/// `ring` to a vertex of the hole (clockwise), around it and back.
void join_hole(LinearRing& ring, const LinearRing& hole) {
  const auto rightmost = std::ranges::max_element(hole, {}, &Point::x);
  const std::size_t at = visible_vertex(ring, *rightmost);
  LinearRing bridge(rightmost, hole.end());
  bridge.insert(bridge.end(), hole.begin(), rightmost + 1);
  bridge.push_back(ring[at]);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(at) + 1, bridge.begin(), bridge.end());
}

bool is_ear(const LinearRing& ring, std::size_t i) {
  const Point a = before(ring, i);
  const Point b = ring[i];
  const Point c = after(ring, i);
  if (!(turn(a, b, c) > 0)) return false;
  return std::ranges::none_of(ring,
                              [&](Point p) { return !(p == a) && !(p == b) && !(p == c) && in_triangle(p, a, b, c); });
}

/// An ear; where rounding leaves none, a corner without area, else any.
std::size_t next_corner(const LinearRing& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (is_ear(ring, i)) return i;
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (turn(before(ring, i), ring[i], after(ring, i)) == 0) return i;
  }
  return 0;
}

void clip(LinearRing ring, std::vector<Triangle>& triangles) {
  while (ring.size() >= 3) {
    const std::size_t i = next_corner(ring);
    const Triangle corner{before(ring, i), ring[i], after(ring, i)};
    if (turn(corner[0], corner[1], corner[2]) > 0) triangles.push_back(corner);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

std::vector<Triangle> triangulation(const MultiPolygon& areas) {
  std::vector<Triangle> triangles;
  for (const Polygon& polygon : areas) {
    Polygon turned = oriented(polygon);
    const auto right_end = [](const LinearRing& ring) {
      return ring.empty() ? 0.0 : std::ranges::max_element(ring, {}, &Point::x)->x;
    };
    std::ranges::sort(turned.holes, std::ranges::greater(), right_end);
    for (const LinearRing& hole : turned.holes) {
      if (hole.size() >= 3 && turned.outer.size() >= 3) join_hole(turned.outer, hole);
    }
    clip(std::move(turned.outer), triangles);
  }
  return triangles;
}

}  // namespace fencepost::host
