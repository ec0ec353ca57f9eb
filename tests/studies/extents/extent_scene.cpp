#include "tests/studies/extents/extent_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"
#include "tests/studies/common/noise_levels.hpp"
#include "tests/studies/common/random_footprint.hpp"

namespace fencepost::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRate = 25;     // frames/s
constexpr double kSpeed = 0.2;   // m/s
constexpr double kTurned = 0.2;  // rad/s, on arcs

struct Draw {
  double turn = 0;      // rad, of everything
  double distance = 0;  // m, from the seen side
  double height = 0;    // m
  double begin = 0;     // of the drive, in [0, 1]
};

Draw draw_of(unsigned seed) {
  Dice dice(seed);
  return {dice.between(-kPi, kPi), dice.between(0.6, 0.9), dice.between(0.1, 0.3), dice.between(0, 1)};
}

host::Polygon box(double x0, double x1, double y0, double y1, double turn) {
  return host::moved({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}}, turn, {0, 0});
}

// Where a drive at `distance` from a box is after `s` metres, counter-clockwise from the middle of the side at +x.
host::TimedPose around(const ExtentCase& wanted, double distance, double s) {
  const double a = wanted.depth / 2;
  const double b = wanted.length / 2;
  const double bend = distance * kPi / 2;
  const double whole = 4 * (a + b + bend);
  s = std::fmod(s + b, whole);
  const std::array<double, 4> sides = {2 * b, 2 * a, 2 * b, 2 * a};
  const std::array<host::Point, 4> corners = {{{a, b}, {-a, b}, {-a, -b}, {a, -b}}};
  double heading = kPi / 2;
  for (std::size_t i = 0; i < sides.size(); ++i, heading += kPi / 2) {
    const host::Point ahead{std::cos(heading), std::sin(heading)};
    if (s < sides[i]) {
      const double back = sides[i] - s;
      return {0, corners[i].x - back * ahead.x + distance * ahead.y, corners[i].y - back * ahead.y - distance * ahead.x,
              heading};
    }
    s -= sides[i];
    if (s < bend) {
      const double now = heading + s / distance;
      return {0, corners[i].x + distance * std::sin(now), corners[i].y - distance * std::cos(now), now};
    }
    s -= bend;
  }
  return {0, a + distance, -b, kPi / 2};
}

// Towards the middle, `away` from it at this angle; the heading is the way on, the camera looks to its left.
host::TimedPose on_circle(double away, double angle) {
  return {0, away * std::cos(angle), away * std::sin(angle), angle + kPi / 2};
}

host::TimedPose pose_at(const ExtentCase& wanted, const Draw& draw, double share) {
  const double half = std::hypot(wanted.length, wanted.depth) / 2;
  switch (wanted.drive) {
    case Drive::kAround: {
      const double whole = 2 * (wanted.length + wanted.depth) + 2 * kPi * draw.distance;
      return around(wanted, draw.distance, (draw.begin + 1.05 * share) * whole);
    }
    case Drive::kCircle: return on_circle(half + draw.distance, 2 * kPi * (draw.begin + 1.02 * share));
    case Drive::kPast: {
      const double way = wanted.length + 1.2;
      return {0, -wanted.depth / 2 - draw.distance, way * (0.5 - share), -kPi / 2};
    }
    default: {
      const double away = wanted.depth / 2 + draw.distance + wanted.length / 4;
      return on_circle(away, kPi * (1 + (share - 0.5) * 2 / 3));
    }
  }
}

double seconds_of(const ExtentCase& wanted, const Draw& draw) {
  switch (wanted.drive) {
    case Drive::kAround: return 1.05 * (2 * (wanted.length + wanted.depth) + 2 * kPi * draw.distance) / kSpeed;
    case Drive::kCircle: return 2 * kPi / kTurned;
    case Drive::kPast: return (wanted.length + 1.2) / kSpeed;
    default: return 2 * kPi / 3 / kTurned;
  }
}

}  // namespace

host::Scene extent_scene(const ExtentCase& wanted) {
  const Draw draw = draw_of(wanted.seed);
  host::Scene scene;
  scene.seed = wanted.seed;
  scene.rate = kRate;
  scene.camera = host::table_camera("extent");
  scene.camera.fx = scene.camera.fy =
      base::Pixels2::nearest(scene.camera.width / 2.0 / std::tan(wanted.degrees * kPi / 360));
  scene.camera.mount.yaw = base::Radians::nearest(kPi / 2);
  scene.noise = scene_noise(noise_levels({std::string(wanted.level)}).front());
  scene.signatures.push_back({1, "red", {200, 40, 40}});
  const double a = wanted.depth / 2;
  const double b = wanted.length / 2;
  host::SceneObject object;
  object.name = "wall";
  object.signature = 1;
  object.height_m = draw.height;
  object.footprint = box(-a, a, -b, b, draw.turn);
  scene.objects = {object};
  host::PosesPath path;
  const double seconds = seconds_of(wanted, draw);
  const int steps = static_cast<int>(seconds * kRate);
  const double c = std::cos(draw.turn);
  const double s = std::sin(draw.turn);
  for (int i = 0; i <= steps; ++i) {
    const host::TimedPose pose = pose_at(wanted, draw, i / static_cast<double>(steps));
    path.poses.push_back({i / kRate, c * pose.x - s * pose.y, s * pose.x + c * pose.y,
                          std::remainder(pose.heading + draw.turn, 2 * kPi)});
  }
  scene.path = path;
  return scene;
}

host::Polygon unseen_with(const ExtentCase& wanted, const host::Scene& scene) {
  constexpr double kBehind = 10;  // m
  const bool back = wanted.drive == Drive::kPast || wanted.drive == Drive::kArc;
  if (!back) return scene.objects.front().footprint;
  return box(-wanted.depth / 2, kBehind, -wanted.length / 2, wanted.length / 2, draw_of(wanted.seed).turn);
}

host::Polygon seen_of(const ExtentCase& wanted, const host::Scene& scene) {
  constexpr double kStrip = 0.02;  // m
  const bool back = wanted.drive == Drive::kPast || wanted.drive == Drive::kArc;
  if (!back) return scene.objects.front().footprint;
  const double face = -wanted.depth / 2;
  return box(face, face + std::min(kStrip, wanted.depth), -wanted.length / 2, wanted.length / 2,
             draw_of(wanted.seed).turn);
}

}  // namespace fencepost::test
