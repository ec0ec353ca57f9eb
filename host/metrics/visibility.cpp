#include "host/metrics/visibility.hpp"

#include <algorithm>
#include <cmath>

#include "host/simulate/optics.hpp"

namespace fencepost::host {
namespace {

/// Nothing nearer to the lens's plane than this is seen, m.
constexpr double kNear = 1e-3;
/// Slopes closer together than this are one.
constexpr double kSameSlope = 1e-12;

/// In the camera's frame a ray of slope m is (1, -m) s, and along a wall 1/s is linear in m. All comparisons below are
/// linear too, so their limits are exact.
struct Linear {
  double at_low = 0;  ///< at the ends of the slab in question
  double at_high = 0;
  friend Linear operator*(double k, Linear f) { return {k * f.at_low, k * f.at_high}; }
  friend Linear operator-(Linear a, Linear b) { return {a.at_low - b.at_low, a.at_high - b.at_high}; }
};

struct Slab {
  double low = 0;
  double high = 0;
  [[nodiscard]] double width() const { return high - low; }
};

/// Where `f` >= 0 within the slab.
Slab not_negative(Linear f, Slab slab) {
  if (f.at_low >= 0 && f.at_high >= 0) return slab;
  if (f.at_low < 0 && f.at_high < 0) return {slab.low, slab.low};
  const double root = slab.low + slab.width() * f.at_low / (f.at_low - f.at_high);
  return f.at_low >= 0 ? Slab{slab.low, root} : Slab{root, slab.high};
}

Slab both(Slab a, Slab b) {
  const double low = std::max(a.low, b.low);
  return {low, std::max(low, std::min(a.high, b.high))};
}

/// One edge of a footprint in the camera's frame.
struct Wall {
  Point a;  ///< x ahead, y left
  Point b;
  std::size_t edge = 0;
  bool outer = false;  ///< of the outer ring
  double low = 0;      ///< slopes of its part ahead of the lens
  double high = 0;
  double inverse_low = 0;  ///< 1/s there
  double inverse_high = 0;

  [[nodiscard]] bool ahead() const { return high - low > kSameSlope; }
  [[nodiscard]] double inverse(double m) const {
    return inverse_low + (inverse_high - inverse_low) * (m - low) / (high - low);
  }
  [[nodiscard]] Linear inverse(Slab slab) const { return {inverse(slab.low), inverse(slab.high)}; }
  /// Where along the edge the ray of slope `m` meets it.
  [[nodiscard]] double along(double m) const {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    return -(a.y + m * a.x) / (dy + m * dx);
  }
  /// The footprint lies to the left of a counter-clockwise edge: its right side must face the lens.
  [[nodiscard]] bool faces_lens() const { return (b.x - a.x) * a.y - (b.y - a.y) * a.x > 0; }
};

Wall wall_of(Point a, Point b) {
  Wall wall{a, b, 0, false, 0, 0, 0, 0};
  if (a.x < kNear && b.x < kNear) return wall;
  const auto cut = [](Point inside, Point outside) {
    return Point{kNear, inside.y + (outside.y - inside.y) * (kNear - inside.x) / (outside.x - inside.x)};
  };
  const Point from = a.x < kNear ? cut(b, a) : a;
  const Point to = b.x < kNear ? cut(a, b) : b;
  wall.low = -from.y / from.x;
  wall.high = -to.y / to.x;
  wall.inverse_low = 1 / from.x;
  wall.inverse_high = 1 / to.x;
  if (wall.low > wall.high) {
    std::swap(wall.low, wall.high);
    std::swap(wall.inverse_low, wall.inverse_high);
  }
  return wall;
}

/// The walls of one object, and its height above the lens.
struct Solid {
  std::vector<Wall> walls;
  double bottom = 0;
  double top = 0;
};

Solid solid_of(const SceneObject& object, const CameraPose& camera) {
  const double c = std::cos(camera.heading);
  const double s = std::sin(camera.heading);
  const auto to_camera = [&](Point p) {
    const double dx = p.x - camera.x;
    const double dy = p.y - camera.y;
    return Point{c * dx + s * dy, -s * dx + c * dy};
  };
  Solid solid;
  solid.bottom = object.base - camera.z;
  solid.top = object.base + object.height_m - camera.z;
  const auto add = [&](const LinearRing& ring, bool outer) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Wall wall = wall_of(to_camera(ring[i]), to_camera(ring[(i + 1) % ring.size()]));
      wall.edge = i;
      wall.outer = outer;
      if (wall.ahead()) solid.walls.push_back(wall);
    }
  };
  add(object.footprint.outer, true);
  for (const LinearRing& hole : object.footprint.holes) add(hole, false);
  return solid;
}

/// The wall that is looked at, its object's height with it.
struct Target {
  const Wall& wall;
  const Solid& solid;
};

/// The part of the slab where the stretch of solid between the walls `front` and `back` hides the target from top to
/// bottom. Seen from above, the far edge of a lid is its upper end.
Slab hidden_by(const Solid& solid, Linear front, Linear back, const Target& target, Slab slab) {
  const Linear inverse = target.wall.inverse(slab);
  const Linear upper = solid.top * (solid.top >= 0 ? front : back);
  const Linear lower = solid.bottom * (solid.bottom <= 0 ? front : back);
  Slab hidden = not_negative(front - inverse, slab);
  hidden = both(hidden, not_negative(upper - target.solid.top * inverse, slab));
  return both(hidden, not_negative(target.solid.bottom * inverse - lower, slab));
}

/// The slab's walls of one solid, nearest first; two by two they bound what is solid (even-odd rule).
std::vector<const Wall*> crossed(const Solid& solid, Slab slab) {
  const double middle = (slab.low + slab.high) / 2;
  std::vector<const Wall*> walls;
  for (const Wall& wall : solid.walls) {
    if (wall.low <= middle && middle < wall.high) walls.push_back(&wall);
  }
  std::sort(walls.begin(), walls.end(),
            [&](const Wall* x, const Wall* y) { return x->inverse(middle) > y->inverse(middle); });
  return walls;
}

void list_hidden(const Solid& solid, const Target& target, Slab slab, std::vector<Slab>& hidden) {
  const std::vector<const Wall*> walls = crossed(solid, slab);
  for (std::size_t i = 0; i + 1 < walls.size(); i += 2) {
    if (walls[i] == &target.wall) return;  // farther walls hide nothing
    const Slab part = hidden_by(solid, walls[i]->inverse(slab), walls[i + 1]->inverse(slab), target, slab);
    if (part.width() > 0) hidden.push_back(part);
  }
}

std::vector<Slab> without(Slab slab, std::vector<Slab> hidden) {
  std::sort(hidden.begin(), hidden.end(), [](Slab a, Slab b) { return a.low < b.low; });
  std::vector<Slab> left;
  double from = slab.low;
  for (const Slab& part : hidden) {
    if (part.low > from) left.push_back({from, part.low});
    from = std::max(from, part.high);
  }
  if (from < slab.high) left.push_back({from, slab.high});
  return left;
}

/// Between these slopes no wall begins or ends.
std::vector<double> breaks_within(const std::vector<Solid>& solids, Slab range) {
  std::vector<double> breaks{range.low, range.high};
  for (const Solid& solid : solids) {
    for (const Wall& wall : solid.walls) {
      for (const double m : {wall.low, wall.high}) {
        if (m > range.low && m < range.high) breaks.push_back(m);
      }
    }
  }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

/// The part of a slab, which the target's wall spans, whose rows are in the image.
Slab in_rows(const Target& target, const FieldOfView& view, Slab slab) {
  const Linear inverse = target.wall.inverse(slab);
  const Linear top = target.solid.top * inverse;
  const Linear bottom = target.solid.bottom * inverse;
  const Linear floor{view.rise_min, view.rise_min};
  const Linear ceiling{view.rise_max, view.rise_max};
  return both(not_negative(top - floor, slab), not_negative(ceiling - bottom, slab));
}

}  // namespace

FieldOfView field_of_view(const sensor::CameraIntrinsics& camera, double pitch) {
  const double cx = camera.cx.to_double();
  const double cy = camera.cy.to_double();
  const auto straight = [&](double offset, double focal) {
    const double distorted = std::abs(offset) / focal;
    const double radius = undistorted_radius(distorted, camera);
    return std::copysign(radius < 0 ? distorted : radius, offset);
  };
  const auto rise = [&](double v) { return -std::tan(pitch + std::atan(straight(v - cy, camera.fy.to_double()))); };
  return {straight(-0.5 - cx, camera.fx.to_double()), straight(camera.width - 0.5 - cx, camera.fx.to_double()),
          rise(camera.height - 0.5), rise(-0.5)};
}

PerimeterPart visible_perimeter(const std::vector<SceneObject>& objects, std::size_t object, const CameraPose& camera,
                                const FieldOfView& view) {
  std::vector<Solid> solids;
  solids.reserve(objects.size());
  for (const SceneObject& other : objects) solids.push_back(solid_of(other, camera));
  PerimeterPart visible(objects[object].footprint.outer);
  for (const Wall& wall : solids[object].walls) {
    if (!wall.outer || !wall.faces_lens()) continue;
    const Target target{wall, solids[object]};
    const Slab range = both({wall.low, wall.high}, {view.across_min, view.across_max});
    if (!(range.width() > kSameSlope)) continue;
    const std::vector<double> breaks = breaks_within(solids, range);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const Slab slab{breaks[i], breaks[i + 1]};
      if (!(slab.width() > kSameSlope)) continue;
      std::vector<Slab> hidden;
      for (const Solid& solid : solids) list_hidden(solid, target, slab, hidden);
      for (const Slab& part : without(slab, hidden)) {
        const Slab shown = both(part, in_rows(target, view, slab));
        if (!(shown.width() > 0)) continue;
        const double from = wall.along(shown.low);
        const double to = wall.along(shown.high);
        visible.add(wall.edge, {std::min(from, to), std::max(from, to)});
      }
    }
  }
  return visible;
}

}  // namespace fencepost::host
