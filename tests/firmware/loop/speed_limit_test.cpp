// The speed limit in a whole run: with each heartbeat, and obeyed it ends at alert.stop and not before.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/loop/flat_drive.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

const FlatFront kWall{1.5, -3, 3};

double limit_of(const record::SpeedLimit& limit) { return limit.speed ? limit.speed->to_double() : -1; }

template <class Robot>
double limit_now(const Robot& robot) {
  return limit_of(robot.pipeline.speed_limit(robot.pipeline.in_force()));
}

// 1.5 m / (0.8 s + 0.4 s)
TEST(SpeedLimit, IsThatOfTheFarthestThatIsKnownWhereNothingIsInTheWay) {
  Drive robot;
  robot.go(1, 0.1, {});
  EXPECT_NEAR(limit_now(robot), 1.25, 1e-4);
}

TEST(SpeedLimit, IsUnknownOfABlindRobotAndZeroAtStop) {
  Drive robot;
  EXPECT_FALSE(robot.pipeline.speed_limit(robot.pipeline.in_force()).speed) << "it has seen nothing yet";
  robot.go(2, 0.1, {kWall});
  ASSERT_TRUE(robot.pipeline.speed_limit(robot.pipeline.in_force()).speed);
  EXPECT_FALSE(robot.pipeline.speed_limit({{}, AlertLevel::kBlind}).speed);
  EXPECT_EQ(robot.pipeline.speed_limit({{}, AlertLevel::kStop}).speed, base::Metres{0});
}

// A camera without a pitch sees no floor: before it knows an object it knows nothing.
TEST(SpeedLimit, IsUnknownWithoutTheFloor) {
  Drive robot;
  sensor::CameraIntrinsics camera = level_pixy2();
  camera.mount.pitch.reset();
  robot.pipeline.set_camera(camera);
  robot.go(1, 0.1, {});
  EXPECT_FALSE(robot.pipeline.speed_limit(robot.pipeline.in_force()).speed);
}

TEST(SpeedLimit, ComesBehindEachHeartbeat) {
  Drive robot;
  robot.go(1.05, 0.1, {kWall});
  ASSERT_GE(robot.alerts.limits.size(), 9U);
  ASSERT_EQ(robot.alerts.limits.size(), robot.alerts.beats.size());
  for (std::size_t i = 0; i < robot.alerts.beats.size(); ++i) {
    EXPECT_EQ(robot.alerts.limits[i].t, robot.alerts.beats[i].t);
  }
}

// Motors that reach the speed they are given in a tenth of a second. STOP is due at 0.26 m, where the limit is
// 0.16 m / 1.2 s. The robot is as fast as 0.4 s before, by a factor of exp(0.4 / 1.2).
template <class Profile>
void obeys(double wanted, double rate) {
  Drive<Profile> robot(rate);
  double speed = 0;
  double fastest = 0;
  double last = 0;
  for (int i = 0; i < 2'000 && robot.highest() != AlertLevel::kStop; ++i) {
    const double limit = limit_now(robot);
    const double given = limit < 0 ? wanted : std::min(wanted, limit);
    speed += 0.1 * (given - speed);
    fastest = std::max(fastest, speed);
    robot.go(0.01, speed, {kWall});
    last = speed;
  }
  EXPECT_GT(fastest, 0.8 * wanted) << wanted << " m/s, " << rate << " frames/s";
  EXPECT_LT(last, std::min(0.19, wanted + 0.01)) << wanted << " m/s, " << rate << " frames/s";
  const double away = kWall.x - robot.x;
  EXPECT_LT(away, 0.29) << wanted << " m/s, " << rate << " frames/s: it came as near as it may";
  EXPECT_GT(away, 0.23) << wanted << " m/s, " << rate << " frames/s";
  EXPECT_EQ(limit_now(robot), 0);
}

TEST(SpeedLimit, ARobotThatObeysSlowsDownAndStopsAtTheStopDistance) {
  for (const double rate : {10.0, 25.0, 50.0}) {
    for (const double wanted : {0.1, 0.3, 0.6}) {
      obeys<config::Micro>(wanted, rate);
      obeys<config::Small>(wanted, rate);
      obeys<config::Full>(wanted, rate);
    }
  }
}

TEST(SpeedLimit, WhoDoesNotSlowDownIsStoppedFartherAway) {
  Drive robot(25);
  while (robot.highest() != AlertLevel::kStop && robot.x < 1.2) robot.go(0.01, 0.6, {kWall});
  EXPECT_GT(kWall.x - robot.x, 0.45);
}

}  // namespace
}  // namespace fencepost::test
