#include "tests/bench/workload.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/recon/models/clip.hpp"

namespace fencepost::bench {
namespace {

using host::Point;

constexpr double kArc = 1.5 * std::numbers::pi;
constexpr double kRange = 1.2;   // m, of the lens from the arena's middle
constexpr double kGuard = 2e-3;  // rad
constexpr double kFar = 6;       // m: a triangle that long leaves the arena everywhere

struct Shape {
  Point middle;
  double radius;
  int corners;
  double turned;
};
constexpr std::array<Shape, kMaxObjects> kShapes{{{{0.02, -0.03}, 0.13, 7, 0.4},
                                                  {{0.42, 0.25}, 0.05, 24, 0.1},
                                                  {{-0.38, 0.30}, 0.10, 4, 1.2},
                                                  {{0.10, -0.48}, 0.15, 5, 0.7},
                                                  {{-0.45, -0.20}, 0.07, 6, 0.2},
                                                  {{0.45, -0.15}, 0.12, 4, 0.5},
                                                  {{0.05, 0.45}, 0.08, 12, 0.9},
                                                  {{-0.15, -0.40}, 0.06, 3, 0.3}}};

host::LinearRing ring_of(const Shape& shape) {
  host::LinearRing ring;
  for (int i = 0; i < shape.corners; ++i) {
    const double angle = shape.turned + 2 * std::numbers::pi * i / shape.corners;
    ring.push_back({shape.middle.x + shape.radius * std::cos(angle), shape.middle.y + shape.radius * std::sin(angle)});
  }
  return ring;
}

Point at(Point from, double bearing, double distance) {
  return {from.x + distance * std::cos(bearing), from.y + distance * std::sin(bearing)};
}

View view_of(const host::LinearRing& object, Point middle, Point lens) {
  const double toward = std::atan2(middle.y - lens.y, middle.x - lens.x);
  double low = 0;
  double high = 0;
  for (const Point& corner : object) {
    const double off = std::remainder(std::atan2(corner.y - lens.y, corner.x - lens.x) - toward, 2 * std::numbers::pi);
    low = std::min(low, off);
    high = std::max(high, off);
  }
  const host::Wedge wedge{lens, toward + low - kGuard, toward + high + kGuard};
  return {wedge, {lens, at(lens, wedge.right, kFar), at(lens, wedge.left, kFar)}};
}

recon::HalfPlane as_robot(const host::HalfPlane& side) {
  return {{static_cast<float>(side.normal.x), static_cast<float>(side.normal.y)}, static_cast<float>(side.offset)};
}

}  // namespace

std::vector<Views> workload(std::size_t objects) {
  std::vector<Views> all;
  for (std::size_t o = 0; o < std::min(objects, kMaxObjects); ++o) {
    Views& object = all.emplace_back();
    object.object = ring_of(kShapes[o]);
    for (std::size_t v = 0; v < kViews; ++v) {
      const double place = -kArc / 2 + kArc * static_cast<double>(v) / (kViews - 1);
      object.views.push_back(view_of(object.object, kShapes[o].middle, at({0, 0}, place, kRange)));
    }
  }
  return all;
}

std::array<Point, 4> arena() {
  constexpr auto h = static_cast<double>(recon::kArenaHalfSide);
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}};
}

recon::HalfPlane left_side(const View& view) { return as_robot(host::left_bound(view.wedge)); }
recon::HalfPlane right_side(const View& view) { return as_robot(host::right_bound(view.wedge)); }

}  // namespace fencepost::bench
