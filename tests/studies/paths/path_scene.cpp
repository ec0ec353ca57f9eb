#include "tests/studies/paths/path_scene.hpp"

#include <cmath>
#include <numbers>

#include "tests/studies/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAside = 0.9;   // m, at which the robot drives past
constexpr double kSquare = 1.0;  // m, half a side

struct Step {
  double x = 0;
  double y = 0;
  double heading = 0;
};

Step winding(double share) {
  constexpr double kWaves = 1.2;
  const double x = -2.7 + 2.1 * share;
  const double y = 0.3 * std::sin(2 * kPi * kWaves * share);
  return {x, y, std::atan2(-y, -x)};  // always towards the middle
}

Step around_corner(double share) {
  constexpr double kDriven = 4 * kSquare;
  if (share < 0.5) return {-kSquare + kDriven * share, -kSquare, 0};
  return {kSquare, -kSquare + kDriven * (share - 0.5), kPi / 2};
}

/// `share` of the way, in [0, 1].
Step step_of(Path path, double share) {
  switch (path) {
    case Path::kApproach: return {-2.7 + 2.15 * share, 0.05, 0};
    case Path::kWinding: return winding(share);
    case Path::kPastSideways: return {-1.6 + 3.2 * share, -kAside, 0};
    case Path::kPastAslant: return {-2.2 + 3.0 * share, -kAside, 0};
    default: return around_corner(share);
  }
}

double camera_yaw(Path path) {
  switch (path) {
    case Path::kPastSideways:
    case Path::kTour: return kPi / 2;
    case Path::kPastAslant: return kPi / 4;
    default: return 0;
  }
}

}  // namespace

host::Scene path_scene(Path path, unsigned seed) {
  host::Scene scene = objects_of_reference(seed);
  scene.camera.mount.yaw = base::Radians::nearest(camera_yaw(path));
  scene.rate = 10;
  host::PosesPath poses;
  for (int i = 0; i < kPathViews; ++i) {
    const Step step = step_of(path, i / (kPathViews - 1.0));
    poses.poses.push_back({i / scene.rate, step.x, step.y, step.heading});
  }
  scene.path = poses;
  return scene;
}

}  // namespace fencepost::test
