#include "host/calibrate/calibrated_robot.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/live/robot_file.hpp"

namespace fencepost::host {
namespace {

Calibration found_calibration() {
  Calibration found;
  found.found.model = "pixy2";
  found.found.width = 316;
  found.found.height = 208;
  found.found.fx = found.found.fy = base::Pixels2::nearest(260.5);
  found.found.mount.z = base::Metres::nearest(0.12);
  found.found.mount.pitch = base::Radians::nearest(0.035);
  found.found.latency = base::Duration::nearest(0.06);
  found.found.lens = sensor::Lens::kEquidistant;
  found.signatures = {{1, {208, 32, 32}, "red"}};
  return found;
}

TEST(CalibratedRobot, IsARobotFileByItself) {
  const auto made = calibrated_robot(found_calibration(), "", "");
  ASSERT_TRUE(made.ok());
  const auto robot = parse_robot(*made, "made");
  ASSERT_TRUE(robot.ok()) << robot.error();
  EXPECT_EQ(robot->camera.over({}), found_calibration().found);
  ASSERT_EQ(robot->signatures.size(), 1U);
  EXPECT_EQ(robot->signatures[0], found_calibration().signatures[0]);
}

// A colour that the file has keeps all but its pad.
TEST(CalibratedRobot, HasThePadsThatWereFound) {
  Calibration found = found_calibration();
  found.signatures = {{1, {208, 32, 32}, "red", 4, 50}, {2, {32, 208, 32}, "green", 4}, {3, {}, "blue"}};
  found.pads = {{1, 0, 4.1, 0.2}, {2, 1, 3.9, 0.2}};
  const auto made = calibrated_robot(
      found, R"({"signatures": [{"id": 1, "name": "tomato", "rgb": "ff0000", "pad": 1}]})", "robot.json");
  ASSERT_TRUE(made.ok()) << made.error().message;
  const auto robot = parse_robot(*made, "made");
  ASSERT_TRUE(robot.ok()) << robot.error();
  ASSERT_EQ(robot->signatures.size(), 2U);
  EXPECT_EQ(robot->signatures[0], (record::Signature{1, {255, 0, 0}, "tomato", 4}));
  EXPECT_EQ(robot->signatures[1], found.signatures[1]);
}

// Wheels that roll 2 % farther, turn 1 % less than configured, and go round by 0.04 rad a metre. The corrected wheels
// have to report the corrected motion: 1.02 of the way, 0.99 of the turn, and 0.04 rad more for each reported metre.
TEST(CalibratedRobot, CorrectsItsWheels) {
  Calibration found = found_calibration();
  found.wheels = {0.02, -0.01, 0.04};
  const auto made = calibrated_robot(found, R"({"wheels": {"metres_per_tick": 0.001, "track": 0.2, "max_speed": 1},
                                                "robot": {"width": 0.3}})",
                                     "robot.json");
  ASSERT_TRUE(made.ok());
  const nlohmann::json robot = nlohmann::json::parse(*made);
  EXPECT_EQ(robot.at("robot").at("width"), 0.3);
  const nlohmann::json& wheels = robot.at("wheels");
  EXPECT_EQ(wheels.at("max_speed"), 1);
  EXPECT_FALSE(wheels.contains("metres_per_tick"));
  const double left = wheels.at("left_metres_per_tick");
  const double right = wheels.at("right_metres_per_tick");
  const double track = wheels.at("track");
  const auto turn = [&](double l, double r) { return (r * right - l * left) / track; };
  EXPECT_NEAR((1000 * left + 1000 * right) / 2, 1.02, 1e-6);
  EXPECT_NEAR(turn(1000, 1000), 0.04, 1e-6);                   // a reported metre straight on
  EXPECT_NEAR(turn(-100, 100) / (2 * 0.1 / 0.2), 0.99, 1e-6);  // a reported turn on the spot
}

TEST(CalibratedRobot, RefusesWhatIsNoRobotFile) {
  const auto made = calibrated_robot(found_calibration(), R"({"camrea": {}})", "robot.json");
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("robot.json"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
