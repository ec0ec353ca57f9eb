// The guard's alert in a whole run: object id 0, said where no object says as much, and always taken back.
#include <gtest/gtest.h>

#include "tests/firmware/loop/flat_drive.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

const FlatFront kWall{1.0, -3, 3};  // wider than the view, so no object ever begins

TEST(GuardAlert, AWallWiderThanTheViewStopsTheRobotInTime) {
  for (const double rate : {10.0, 50.0}) {
    for (const double speed : {0.05, 0.1, 0.2}) {
      Drive robot(rate);
      robot.go(0.65 / speed, speed, {kWall});
      EXPECT_NE(robot.highest(), AlertLevel::kStop) << "0.35 m is not near, at " << speed << " m/s, rate " << rate;
      EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kWarn);
      robot.go(0.1 / speed, speed, {kWall});
      ASSERT_EQ(robot.level_of(record::kNoObject), AlertLevel::kStop) << speed << " m/s, rate " << rate;
      const record::AlertReport& last = robot.alerts.all.back();
      EXPECT_EQ(last.id, record::kNoObject);
      EXPECT_EQ(last.signature, 1);
      EXPECT_NEAR(last.distance.to_double(), 1.0 - robot.x, 0.03);
      EXPECT_NEAR(last.bearing.to_double(), 0, 0.4);
      EXPECT_TRUE(last.ttc.has_value());
      EXPECT_EQ(last.confidence.raw, 100);
    }
  }
}

// robot.width says nothing of a nose of 0.4 m: without robot.front it stops at 0.25 m from the origin, in the wall.
TEST(GuardAlert, StopsBeforeTheNoseTouches) {
  for (const double speed : {0.05, 0.2}) {
    Drive robot;
    ASSERT_FALSE(robot.pipeline.set("robot.front", "0.4"));
    robot.go(0.40 / speed, speed, {kWall});
    EXPECT_EQ(robot.highest(), AlertLevel::kWarn) << speed;
    robot.go(0.06 / speed, speed, {kWall});
    ASSERT_EQ(robot.highest(), AlertLevel::kStop) << "0.54 m from the origin, 0.14 m from the nose, at " << speed;
    const record::AlertReport& last = robot.alerts.all.back();
    EXPECT_NEAR(last.distance.to_double(), 1.0 - robot.x, 0.06);
    EXPECT_NEAR(last.ttc->to_double(), (1.0 - robot.x - 0.4) / speed, 0.05 / speed);
  }
}

// Turned round before the wall, it backs towards what it does not see any more.
TEST(GuardAlert, StopsWhenTheRearReachesTheWallBehind) {
  for (const bool told : {true, false}) {
    Drive robot;
    if (told) {
      ASSERT_FALSE(robot.pipeline.set("robot.rear", "0.3"));
    }
    robot.go(2, 0.2, {kWall});  // 0.6 m before it
    robot.go(3.14159 / 1.5, 0, {}, 1.5);
    robot.go(0.7, 0, {});
    ASSERT_EQ(robot.highest(), AlertLevel::kClear);
    robot.go(0.5, -0.2, {});
    EXPECT_NE(robot.highest(), AlertLevel::kStop) << "0.5 m";
    robot.go(0.35, -0.2, {});  // 0.43 m from the origin, 0.13 m from the rear
    EXPECT_EQ(robot.highest() == AlertLevel::kStop, told);
    robot.go(5, 0, {});
    EXPECT_EQ(robot.highest() == AlertLevel::kStop, told) << "it obeyed";
    if (told) {
      EXPECT_NEAR(std::fabs(robot.alerts.all.back().bearing.to_double()), 3.14, 0.5);
    }
  }
}

// Below the lens the wall is no longer seen. The robot obeys and stands for ten minutes, and stop stays in force.
TEST(GuardAlert, LastsWhileTheObstacleIsBelowTheImage) {
  Drive robot;
  robot.go(3.25, 0.2, {kWall});
  robot.go(0.45, 0.2, {});  // it is lower than the lens
  ASSERT_EQ(robot.level_of(record::kNoObject), AlertLevel::kStop);
  robot.go(600, 0, {});
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kStop);
  robot.go(1, -0.2, {});  // it backs off: the wall ahead is not on its way now
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear);
  robot.go(1, 0.1, {});  // and 0.45 m away it saw that nothing is there
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear);
}

// Taken away before its eyes: clear within a second, whatever is behind it and at any rate.
TEST(GuardAlert, EndsWithinASecondWhenTheObstacleIsTakenAway) {
  for (const double rate : {10.0, 12.5, 50.0}) {
    for (const bool wall_behind : {false, true}) {
      Drive robot(rate);
      robot.go(3, 0.2, {kWall});  // 0.4 m
      ASSERT_EQ(robot.level_of(record::kNoObject), AlertLevel::kWarn);
      std::vector<FlatFront> background;
      if (wall_behind) background.push_back({1.5, -3, 3, 2});
      robot.go(1, 0, background);
      EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear) << rate << " wall " << wall_behind;
    }
  }
}

// An alert that eases stays in force for a while: no clear is sent before that time is over.
TEST(GuardAlert, IsNotTakenBackWhileItIsInForce) {
  Drive robot(50);
  robot.go(3, 0.2, {kWall});
  std::size_t told = robot.alerts.all.size();
  unsigned clears = 0;
  for (int i = 0; i < 150; ++i) {
    robot.go(0.01, 0, {});
    for (; told < robot.alerts.all.size(); ++told) {
      const record::AlertReport& alert = robot.alerts.all[told];
      if (alert.id != record::kNoObject || alert.level != AlertLevel::kClear) continue;
      ++clears;
      EXPECT_EQ(robot.pipeline.in_force().level, AlertLevel::kClear) << alert.t.raw;
    }
  }
  EXPECT_EQ(clears, 1U);
}

// A post is an object's to tell: the guard has nothing to add.
TEST(GuardAlert, DoesNotRepeatWhatAnObjectSays) {
  Drive robot;
  const FlatFront post{1.0, -0.05, 0.05};
  robot.go(3.6, 0.2, {post});
  EXPECT_EQ(robot.highest(), AlertLevel::kStop);
  for (const record::AlertReport& alert : robot.alerts.all) {
    if (alert.id != record::kNoObject) continue;
    // Only while it is the first to know: for some frames, before the object says as much.
    AlertLevel others = AlertLevel::kClear;
    for (const record::AlertReport& other : robot.alerts.all) {
      if (other.id != record::kNoObject && other.t <= alert.t) others = other.level;
    }
    EXPECT_TRUE(alert.level == AlertLevel::kClear || alert.level >= others);
  }
}

// The map loses the object: its slot goes to others, it divides in two, its models restart. The guard still reports
// the obstacle.
TEST(GuardAlert, CoversWhatTheMapLoses) {
  Drive<config::Micro> robot;
  const FlatFront post{0.8, -0.06, 0.06};
  robot.go(2, 0.2, {post});
  ASSERT_GE(robot.highest(), AlertLevel::kWarn);
  // In two pieces with a gap: the object divides.
  const std::vector<FlatFront> halves = {{0.8, -0.06, -0.015}, {0.8, 0.015, 0.06}};
  for (int i = 0; i < 20; ++i) {
    robot.go(0.1, 0.02, halves);
    EXPECT_GE(robot.highest(), AlertLevel::kWarn) << i;
  }
}

TEST(GuardAlert, ANewRunAndANewCalibrationForget) {
  Drive robot;
  robot.go(3.7, 0.2, {kWall});
  ASSERT_FALSE(robot.memory->map.guard().fronts().empty());
  robot.pipeline.set_camera(level_pixy2());  // the same again
  EXPECT_FALSE(robot.memory->map.guard().fronts().empty());
  sensor::CameraIntrinsics other = level_pixy2();
  other.mount.z = base::Metres::nearest(0.13);
  robot.pipeline.set_camera(other);
  EXPECT_TRUE(robot.memory->map.guard().fronts().empty());
  robot.go(1, 0, {});
  EXPECT_EQ(robot.level_of(record::kNoObject), AlertLevel::kClear) << "and clear was said";
  robot.go(2, -0.2, {kWall});
  ASSERT_FALSE(robot.memory->map.guard().fronts().empty());
  robot.pipeline.restart();
  EXPECT_TRUE(robot.memory->map.guard().fronts().empty());
}

// Two runs that differ in what the guard knows alone.
TEST(GuardAlert, IsPartOfTheDigest) {
  const auto digest = [](bool other) {
    Drive robot;
    robot.go(1, 0.1, {kWall});
    if (other) robot.memory->map.recalibrated();
    robot.go(1, 0.1, {});
    return robot.memory->map.digest();
  };
  EXPECT_EQ(digest(false), digest(false));
  EXPECT_NE(digest(false), digest(true));
}

}  // namespace
}  // namespace fencepost::test
