#include "host/render/solid_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::host {
namespace {

/// Nothing nearer than this is drawn, m.
constexpr double kNear = 0.01;
constexpr double kLightAngle = 0.7 * std::numbers::pi;  ///< direction of the light
constexpr double kAmbient = 0.55;                       ///< brightness of faces that look away from it
constexpr double kLidLight = 1.0;
constexpr double kUndersideLight = 0.35;

/// Along the optical axis, left, up; m from the lens.
struct Corner {
  double ahead = 0;
  double left = 0;
  double up = 0;
};

class Viewer {
 public:
  explicit Viewer(const Projection& projection) : projection_(projection) {}

  [[nodiscard]] Corner at(Point p, double z) const {
    const CameraPose& lens = projection_.lens;
    const double c = std::cos(lens.heading);
    const double s = std::sin(lens.heading);
    const double dx = p.x - lens.x;
    const double dy = p.y - lens.y;
    const double ahead = c * dx + s * dy;
    const double up = z - lens.z;
    const double cp = std::cos(projection_.pitch);
    const double sp = std::sin(projection_.pitch);
    return {cp * ahead - sp * up, -s * dx + c * dy, sp * ahead + cp * up};
  }

  /// Empty if all of it is behind the lens.
  [[nodiscard]] LinearRing outline(const std::vector<Corner>& corners) const {
    LinearRing ring;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner& a = corners[i];
      const Corner& b = corners[(i + 1) % corners.size()];
      if (a.ahead >= kNear) ring.push_back(image(a));
      if ((a.ahead >= kNear) == (b.ahead >= kNear)) continue;
      const double t = (kNear - a.ahead) / (b.ahead - a.ahead);
      ring.push_back(image({kNear, a.left + t * (b.left - a.left), a.up + t * (b.up - a.up)}));
    }
    return ring;
  }

 private:
  [[nodiscard]] Point image(const Corner& c) const { return project(projection_, c.ahead, c.left, c.up); }
  const Projection& projection_;
};

void add_walls(const Solid& solid, const LinearRing& ring, const Projection& projection, std::vector<Face>& faces) {
  const Viewer viewer(projection);
  const CameraPose& lens = projection.lens;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    // The solid is on the left of its rings, outer ones and holes.
    const Point normal{(b.y - a.y) / length, -(b.x - a.x) / length};
    if (!(length > 0) || (lens.x - a.x) * normal.x + (lens.y - a.y) * normal.y <= 0) continue;
    LinearRing outline = viewer.outline(
        {viewer.at(a, solid.z_min), viewer.at(b, solid.z_min), viewer.at(b, solid.z_max), viewer.at(a, solid.z_max)});
    if (outline.size() < 3) continue;
    const double lit = 0.5 + 0.5 * (normal.x * std::cos(kLightAngle) + normal.y * std::sin(kLightAngle));
    faces.push_back({{std::move(outline)},
                     kAmbient + (0.9 - kAmbient) * lit,
                     std::hypot((a.x + b.x) / 2 - lens.x, (a.y + b.y) / 2 - lens.y)});
  }
}

void add_flat(const Polygon& polygon, double z, double light, const Projection& projection, std::vector<Face>& faces) {
  const Viewer viewer(projection);
  const auto ring_of = [&](const LinearRing& ring) {
    std::vector<Corner> corners;
    for (const Point& p : ring) corners.push_back(viewer.at(p, z));
    return viewer.outline(corners);
  };
  Face face{{ring_of(polygon.outer)}, light, 0};
  if (face.rings.front().size() < 3) return;
  for (const LinearRing& hole : polygon.holes) {
    LinearRing ring = ring_of(hole);
    if (ring.size() >= 3) face.rings.push_back(std::move(ring));
  }
  faces.push_back(std::move(face));
}

}  // namespace

Point project(const Projection& projection, double ahead, double left, double up) {
  return {projection.cx - projection.fx * left / ahead, projection.cy - projection.fy * up / ahead};
}

std::vector<Face> visible_faces(const Solid& solid, const Projection& projection) {
  std::vector<Face> faces;
  for (const Polygon& polygon : solid.footprint) {
    add_walls(solid, polygon.outer, projection, faces);
    for (const LinearRing& hole : polygon.holes) add_walls(solid, hole, projection, faces);
  }
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.distance > b.distance; });
  for (const Polygon& polygon : solid.footprint) {
    if (projection.lens.z > solid.z_max) add_flat(polygon, solid.z_max, kLidLight, projection, faces);
    if (projection.lens.z < solid.z_min) add_flat(polygon, solid.z_min, kUndersideLight, projection, faces);
  }
  return faces;
}

}  // namespace fencepost::host
