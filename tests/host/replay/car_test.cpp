// A car's readings, from the simulator through the replay: where it went, what is said of readings that cannot be used.
#include <gtest/gtest.h>

#include <cmath>

#include "host/replay/replay.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

/// Two laps of a rounded square with a post in the middle of it, after a second on the spot.
host::Scene laps(host::SceneOdometry::Kind kind) {
  const auto scene = host::parse_scene(R"({"format": 1, "seed": 3,
    "camera": {"model": "pixy2", "width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 103.5,
      "k1": 0, "mount": {"x": 0.05, "y": 0, "z": 0.12, "yaw": 1.2, "pitch": 0}, "latency": 0.05, "rate": 10,
      "max_blobs": 16},
    "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}],
    "objects": [{"name": "post", "signature": 1, "base": 0, "height": 0.1, "footprint": {"circle": [0.5, 0.5, 0.04]}}],
    "path": {"type": "waypoints", "points": [[0.5, 0], [1, 0], [1, 1], [0, 1], [0, 0]], "speed": 0.3,
      "turn_radius": 0.3, "laps": 2, "wait": 1}})",
                                       "laps");
  host::Scene result = *scene;
  result.odometry = {kind, 2'000, 0.15};
  return result;
}

std::string log_of(const host::Scene& scene) {
  std::string log;
  EXPECT_TRUE(host::simulate(scene, [&](std::string_view line) { log += line; }).ok());
  return log;
}

// The car's last pose, by its readings alone.
host::PoseResult end_of(const host::Scene& scene) {
  host::ReplayOptions options;
  options.settings = {{"correct.pose", "off"}};
  const host::ReplayOutcome outcome = host::replay(log_of(scene), "laps", options);
  EXPECT_FALSE(outcome.unreadable);
  EXPECT_TRUE(outcome.complaints.empty()) << outcome.complaints.front();
  return outcome.result.pose.value_or(host::PoseResult{});
}

// It ends where it began, heading along x; counts are 0.5 mm.
void expect_back(const host::PoseResult& end, double metres, double radians) {
  EXPECT_NEAR(end.x, 0.0, metres);
  EXPECT_NEAR(end.y, 0.0, metres);
  EXPECT_NEAR(std::remainder(end.heading, 2 * std::acos(-1.0)), 0.0, radians);
}

TEST(Car, TwoLapsByGyroEndWhereTheyBegan) { expect_back(end_of(laps(host::SceneOdometry::Kind::kGyro)), 3e-3, 1e-3); }

TEST(Car, TwoLapsBySteeringAngleEndWhereTheyBegan) {
  expect_back(end_of(laps(host::SceneOdometry::Kind::kSteering)), 0.02, 0.02);
}

TEST(Car, ABiasedGyroIsCalibratedBeforeItGoes) {
  host::Scene scene = laps(host::SceneOdometry::Kind::kGyro);
  scene.noise.gyro_bias = 0.05;
  expect_back(end_of(scene), 4e-3, 2e-3);
  std::get<host::WaypointPath>(scene.path).wait = 0;
  // 27 s of 0.05 rad/s and nobody noticed.
  const host::PoseResult lost = end_of(scene);
  EXPECT_GT(std::hypot(lost.x, lost.y), 0.2);
}

TEST(Car, EachErrorOfTheReadingsShows) {
  using Member = double host::SceneNoise::*;
  const auto off = [](host::SceneOdometry::Kind kind, Member member, double value) {
    host::Scene scene = laps(kind);
    scene.noise.*member = value;
    const host::PoseResult end = end_of(scene);
    return std::hypot(end.x, end.y) + std::abs(std::remainder(end.heading, 2 * std::acos(-1.0)));
  };
  using Kind = host::SceneOdometry::Kind;
  EXPECT_GT(off(Kind::kGyro, &host::SceneNoise::gyro_scale, 0.02), 0.1);
  EXPECT_GT(off(Kind::kGyro, &host::SceneNoise::gyro_walk, 0.01), 0.05);
  EXPECT_GT(off(Kind::kGyro, &host::SceneNoise::gyro_noise, 0.2), 0.005);
  EXPECT_GT(off(Kind::kSteering, &host::SceneNoise::steer_offset, 0.02), 0.1);
  EXPECT_GT(off(Kind::kSteering, &host::SceneNoise::steer_scale, 0.05), 0.1);
  EXPECT_GT(off(Kind::kSteering, &host::SceneNoise::steer_backlash, 0.05), 0.05);
}

TEST(Car, ARobotsOwnLogOfItReplaysToTheSameMap) {
  std::string own;
  host::ReplayOptions options;
  options.log = [&](std::string_view line) { own += line; };
  const host::ReplayOutcome first = host::replay(log_of(laps(host::SceneOdometry::Kind::kGyro)), "car", options);
  EXPECT_EQ(own.find("$FPCAR"), std::string::npos) << "poses, so that any reader of logs can use it";
  EXPECT_NE(own.find("$FPODO"), std::string::npos);
  const host::ReplayOutcome again = host::replay(own, "own", {});
  EXPECT_EQ(again.result.digest, first.result.digest);
  EXPECT_EQ(again.result.log.odometry, first.result.log.odometry);
}

TEST(Car, WhatCannotBeUsedIsSaidOnce) {
  const std::string head = line_of(record::Header{1, "test", "0", "test", "full"});
  const auto complaint = [&](const std::string& lines) {
    const host::ReplayOutcome outcome = host::replay(head + lines, "car", {});
    return outcome.complaints.size() == 1 ? outcome.complaints.front() : std::to_string(outcome.complaints.size());
  };
  const auto set = [](const char* key, const char* value) { return line_of(record::Setting{key, value}); };
  const auto car = [](double t, bool angle) {
    sensor::CarSample sample{base::Time::nearest(t), 1, {}, {}};
    if (angle) sample.steering = base::Radians{100};
    return line_of(sample);
  };
  EXPECT_NE(complaint(car(1, true) + car(2, true)).find("set car.counts"), std::string::npos);
  EXPECT_NE(complaint(set("car.counts", "2000") + car(1, false)).find("send one of the two"), std::string::npos);
  EXPECT_NE(complaint(set("car.counts", "2000") + car(1, true)).find("set car.wheelbase"), std::string::npos);
}

TEST(Car, WhatItDroveRoundWasPassedOnItsRight) {
  // Counter-clockwise round the post: it is to the left all the time, and ahead and behind once a side of the square.
  const host::ReplayOutcome outcome = host::replay(log_of(laps(host::SceneOdometry::Kind::kGyro)), "laps", {});
  ASSERT_GE(outcome.result.passes.size(), 5U);
  for (const host::PassResult& pass : outcome.result.passes) {
    EXPECT_TRUE(pass.on_the_right) << pass.t;
    EXPECT_NEAR(pass.distance, 0.46, 0.05) << pass.t;
    EXPECT_LT(pass.known_at, pass.t);
  }
}

}  // namespace
}  // namespace fencepost::test
