#include "host/export/prism.hpp"

#include <algorithm>
#include <cmath>

#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"

namespace fencepost::host::exports {
namespace {

using Corner = std::array<float, 3>;

Corner corner(Point p, double z) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(z)}; }

void add_face(Mesh& mesh, std::initializer_list<Corner> corners, Corner normal) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Corner& point : corners) {
    mesh.points.push_back(point);
    mesh.normals.push_back(normal);
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
  }
}

void add_wall(Mesh& mesh, const LinearRing& ring, double low, double high) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;
    // Solid is to the left of an oriented ring.
    const Corner outward = corner({(b.y - a.y) / length, -(b.x - a.x) / length}, 0);
    add_face(mesh, {corner(a, low), corner(b, low), corner(b, high), corner(a, high)}, outward);
  }
}

}  // namespace

Mesh extruded(const MultiPolygon& areas, double low, double high) {
  Mesh mesh;
  for (const Triangle& t : triangulation(areas)) {
    add_face(mesh, {corner(t[0], high), corner(t[1], high), corner(t[2], high)}, {0, 0, 1});
    add_face(mesh, {corner(t[2], low), corner(t[1], low), corner(t[0], low)}, {0, 0, -1});
  }
  for (const Polygon& polygon : areas) {
    const Polygon turned = oriented(polygon);
    add_wall(mesh, turned.outer, low, high);
    for (const LinearRing& hole : turned.holes) add_wall(mesh, hole, low, high);
  }
  return mesh;
}

Band band_of(const ObjectResult& object) {
  constexpr double kFlattest = 0.01;
  return {object.z_min, std::max(object.z_max, object.z_min + kFlattest)};
}

}  // namespace fencepost::host::exports
