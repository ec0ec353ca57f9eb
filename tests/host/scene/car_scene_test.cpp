// Scenes of cars: round paths, laps, what their odometry tells and what is refused of it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "host/scene/load.hpp"
#include "host/scene/rounded_path.hpp"

namespace fencepost::host {
namespace {

LoadedScene scene_with(const std::string& path, const std::string& rest = "") {
  return parse_scene(R"({"format": 1, "camera": {"width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5,
    "cy": 103.5}, "signatures": [], "objects": [], "path": {"type": "waypoints", "points": [[0.5, 0], [1, 0], [1, 1],
    [0, 1], [0, 0]], )" + path +
                         "}" + rest + "}",
                     "car");
}

std::string fault(const std::string& path, const std::string& rest = "") {
  const LoadedScene scene = scene_with(path, rest);
  return scene.ok() ? "" : scene.error().message();
}

TEST(CarScene, DrivesRoundItsCorners) {
  const LoadedScene scene = scene_with(R"("speed": 0.5, "turn_radius": 0.25, "laps": 2, "wait": 1)");
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  const auto knots = rounded_knots(std::get<WaypointPath>(scene->path));
  // A lap: four sides of 1 m, each less 2 x 0.25 m, and a circle of 0.25 m.
  const double lap = 4 * 0.5 + 2 * std::numbers::pi * 0.25;
  EXPECT_NEAR(knots.back().t, 1 + 2 * lap / 0.5, 1e-9);
  EXPECT_NEAR(knots.back().x, 0.5, 1e-9);
  EXPECT_NEAR(knots.back().y, 0.0, 1e-9);
  EXPECT_NEAR(knots.back().heading, 4 * std::numbers::pi, 1e-9);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double turn = std::abs(knots[i].heading - knots[i - 1].heading);
    EXPECT_LE(turn, 2.01 * std::numbers::pi / 180);
    EXPECT_GE(std::hypot(knots[i].x - knots[i - 1].x, knots[i].y - knots[i - 1].y), 0.999 * 0.25 * turn);
  }
}

TEST(CarScene, SaysWhichCornerHasNoRoom) {
  EXPECT_EQ(fault(R"("turn_radius": 0.5, "laps": 1)"), "");
  EXPECT_NE(fault(R"("turn_radius": 0.51, "laps": 1)").find("/path/points/1: its arc has no room"), std::string::npos);
  EXPECT_NE(fault(R"("turn_radius": 0.2, "turn_rate": 1)").find("leave turn_rate out"), std::string::npos);
}

TEST(CarScene, ReadsWhatTheWheelsTellAndWritesItAgain) {
  const LoadedScene scene = scene_with(R"("turn_radius": 0.2, "laps": 3, "wait": 2)",
                                       R"(, "odometry": {"kind": "steering", "counts": 2046, "wheelbase": 0.17},
                                       "noise": {"steer_backlash": 0.02, "drift_scale": 0.01})");
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  EXPECT_EQ(scene->odometry.kind, SceneOdometry::Kind::kSteering);
  EXPECT_EQ(scene->noise.steer_backlash, 0.02);
  const std::string written = write_scene(*scene);
  const LoadedScene again = parse_scene(written, "again");
  ASSERT_TRUE(again.ok()) << again.error().message();
  EXPECT_EQ(write_scene(*again), written);
  EXPECT_EQ(again->odometry.wheelbase, 0.17);
  EXPECT_EQ(std::get<WaypointPath>(again->path).laps, 3);
}

TEST(CarScene, RefusesErrorsThatItsOdometryCannotHave) {
  const std::string path = R"("turn_radius": 0.2)";
  const std::string gyro = R"(, "odometry": {"kind": "gyro", "counts": 2046}, "noise": )";
  EXPECT_EQ(fault(path, gyro + R"({"gyro_bias": 0.1})"), "");
  EXPECT_NE(fault(path, gyro + R"({"pose_xy": 0.1})").find("/noise/pose_xy: is of poses"), std::string::npos);
  EXPECT_NE(fault(path, gyro + R"({"steer_offset": 0.1})").find("/noise/steer_offset: is of a steering angle"),
            std::string::npos);
  EXPECT_NE(fault(path, R"(, "noise": {"gyro_bias": 0.1})").find("add \"odometry\""), std::string::npos);
  EXPECT_NE(fault(path, R"(, "odometry": {"kind": "steering", "counts": 2046})").find("wheelbase"), std::string::npos);
  EXPECT_NE(fault(path, R"(, "odometry": {"kind": "compass", "counts": 2046})").find("write \"gyro\""),
            std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
