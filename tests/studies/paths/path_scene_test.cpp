// The paths against their definition.
#include "tests/studies/paths/path_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "tests/studies/paths/path_run.hpp"
#include "tests/studies/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<host::TimedPose> poses_of(Path path) { return std::get<host::PosesPath>(path_scene(path, 3).path).poses; }

void expect_pose(const host::TimedPose& pose, double x, double y, double heading) {
  EXPECT_NEAR(pose.x, x, 1e-9);
  EXPECT_NEAR(pose.y, y, 1e-9);
  EXPECT_NEAR(std::remainder(pose.heading - heading, 2 * kPi), 0, 1e-9);
}

TEST(PathScene, BeginsAndEndsWhereItShould) {
  for (const PathText& path : kPaths) ASSERT_EQ(poses_of(path.path).size(), 60U) << path.name;
  expect_pose(poses_of(Path::kApproach).front(), -2.7, 0.05, 0);
  expect_pose(poses_of(Path::kApproach).back(), -0.55, 0.05, 0);
  expect_pose(poses_of(Path::kWinding).front(), -2.7, 0, 0);
  // 0.3 sin(72 degrees); towards the middle by atan(0.2853 / 0.6).
  expect_pose(poses_of(Path::kWinding).back(), -0.6, 0.285316954888546, -0.44387925940723716);
  expect_pose(poses_of(Path::kPastSideways).front(), -1.6, -0.9, 0);
  expect_pose(poses_of(Path::kPastSideways).back(), 1.6, -0.9, 0);
  expect_pose(poses_of(Path::kPastAslant).back(), 0.8, -0.9, 0);
  expect_pose(poses_of(Path::kTour).front(), -1, -1, 0);
  expect_pose(poses_of(Path::kTour).back(), 1, 1, kPi / 2);
}

TEST(PathScene, TheCameraLooksWhereTheObjectsAre) {
  EXPECT_EQ(path_scene(Path::kApproach, 3).camera.mount.yaw.to_double(), 0);
  EXPECT_NEAR(path_scene(Path::kPastAslant, 3).camera.mount.yaw.to_double(), kPi / 4, 1e-4);
  EXPECT_NEAR(path_scene(Path::kTour, 3).camera.mount.yaw.to_double(), kPi / 2, 1e-4);
}

TEST(PathScene, ObjectsAreThoseOfTheTables) {
  const host::Scene circle = reference_scene(3);
  const host::Scene path = path_scene(Path::kTour, 3);
  ASSERT_EQ(path.objects.size(), circle.objects.size());
  for (std::size_t i = 0; i < path.objects.size(); ++i) {
    EXPECT_EQ(path.objects[i].footprint.outer.front().x, circle.objects[i].footprint.outer.front().x);
  }
}

TEST(PathRun, DriftMakesItWorseAndTheFeedsDiffer) {
  PathOptions options;
  options.path = Path::kTour;
  options.feed = Feed::kGiven;
  const auto sum = [&] {
    double total = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
      options.seed = seed;
      for (const ObjectScores& object : run_path(options)) {
        total += object.at("hybrid").recklessness + object.at("hybrid").paranoia;
      }
    }
    return total;
  };
  const double given = sum();
  options.feed = Feed::kLog;
  const double from_log = sum();
  options.drift = true;
  const double drifting = sum();
  options.feed = Feed::kCorrected;
  EXPECT_NE(given, from_log);
  EXPECT_GT(drifting, from_log);
  EXPECT_NE(sum(), drifting);
}

}  // namespace
}  // namespace fencepost::test
