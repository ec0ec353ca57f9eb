#include "firmware/alert/front_alert.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hal/base/trig.hpp"

namespace fencepost::test {
namespace {

using alert::FrontAhead;
using recon::guard::Front;
using record::AlertLevel;

/// Alerts about points in mm ahead of a robot at the origin.
class Fronts : public testing::Test {
 protected:
  void put(int x, int y, unsigned frames = 0xFF, unsigned signature = 1) {
    fronts_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::uint8_t>(frames), 0,
                       0, static_cast<std::uint8_t>(signature)});
  }
  FrontAhead see() const {
    return see_fronts(fronts_, {}, alert::RobotPlace(robot_), path_, alert::AlertRules(settings_));
  }
  std::vector<Front> fronts_;
  recon::MapPose robot_;
  alert::RobotPath path_;
  config::Settings settings_;
};

TEST_F(Fronts, NearInTheWayWarnsAndStops) {
  EXPECT_EQ(see().due, AlertLevel::kClear);
  put(501, 0);
  EXPECT_EQ(see().due, AlertLevel::kClear);
  put(500, 0);
  EXPECT_EQ(see().due, AlertLevel::kWarn);
  put(263, 0);
  EXPECT_EQ(see().due, AlertLevel::kWarn);
  put(262, 0);  // 0.25 m and three sigmas of the pose
  EXPECT_EQ(see().due, AlertLevel::kStop);
}

// The guard's millimetres count from its origin, wherever that is.
TEST_F(Fronts, AreWhereTheGuardsOriginPutsThem) {
  constexpr std::int32_t kMillimetre = recon::kMapUnitsPerMetre / 1'000;
  const recon::MapPoint origin = {3'000 * kMillimetre, -2'000 * kMillimetre};
  robot_.position = {3'500 * kMillimetre, -1'750 * kMillimetre};
  const auto seen = [&] {
    return see_fronts(fronts_, origin, alert::RobotPlace(robot_), path_, alert::AlertRules(settings_));
  };
  put(500 + 265, 250);
  EXPECT_EQ(seen().due, AlertLevel::kWarn);
  EXPECT_FLOAT_EQ(seen().nearest.toward.x(), 0.265F);
  EXPECT_FLOAT_EQ(seen().nearest.toward.y(), 0);
  put(500 + 261, 250);
  EXPECT_EQ(seen().due, AlertLevel::kStop);
}

TEST_F(Fronts, BesideTheWaySaysNothing) {
  put(240, 125);
  put(240, -125);
  put(-200, 0);
  EXPECT_EQ(see().due, AlertLevel::kClear);
  EXPECT_FALSE(see().nearest.known);
}

TEST_F(Fronts, ConfirmAnObjectWhosePlaceIsAGuess) {
  put(362, 0);  // 0.25 m, by 0.4 of it more, and three sigmas of the pose
  EXPECT_TRUE(see().something);
  fronts_.clear();
  put(363, 0);
  EXPECT_FALSE(see().something);
  fronts_.clear();
  put(240, 145);  // in the outermost of the margin
  EXPECT_TRUE(see().something);
  EXPECT_EQ(see().due, AlertLevel::kClear);
  fronts_.clear();
  put(240, 155);
  EXPECT_FALSE(see().something);
}

TEST_F(Fronts, AreWithinReachOfAPlace) {
  const auto within = [&](float reach) {
    return front_within(fronts_, {}, alert::RobotPlace(robot_), recon::Vec2{0.4F, 0.1F}, reach);
  };
  EXPECT_FALSE(within(1));
  put(400, 200);
  EXPECT_TRUE(within(0.051F));
  EXPECT_FALSE(within(0.049F));
  fronts_.clear();
  put(400, 100, 0x03);
  EXPECT_FALSE(within(0.1F)) << "two frames may be noise";
  put(410, 100, 0x04);
  EXPECT_TRUE(within(0.1F)) << "points of one thing";
  robot_.position = {recon::kMapUnitsPerMetre / 2, 0};
  EXPECT_FALSE(within(0.1F)) << "the robot has moved on";
}

// As floats have it, point by point: whole millimetres never say more or less. Half of the points are on the very edge.
TEST_F(Fronts, AreWithinReachAsFloatsHaveIt) {
  std::mt19937 random(1);
  const auto any = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  constexpr std::int32_t kUnits = recon::kMapUnitsPerMetre / 1'000;
  int within = 0;
  for (int i = 0; i < 20'000; ++i) {
    const recon::MapPoint origin{any(-20'000, 20'000) * kUnits, any(-20'000, 20'000) * kUnits};
    robot_.position = {origin.x + any(-800'000, 800'000), origin.y + any(-800'000, 800'000)};
    robot_.heading = any(-3'141'592, 3'141'592);
    const alert::RobotPlace robot(robot_);
    const recon::Vec2 place{0.001F * static_cast<float>(any(-1'500, 1'500)),
                            0.001F * static_cast<float>(any(-1'500, 1'500))};
    const float reach = 0.0001F * static_cast<float>(any(100, 6'000));
    const recon::Vec2 from = recon::offset_from(robot.position, origin);
    const float distance = i % 2 == 0 ? reach + alert::kFrontRadius : 0.001F * static_cast<float>(any(0, 900));
    const base::SinCos way = base::sincos_urad(any(-3'141'592, 3'141'592));
    const recon::Vec2 at = recon::rotated(robot.heading, place + distance * recon::Vec2{way.cos, way.sin}) - from;
    fronts_.clear();
    put(recon::nearest_whole(1'000 * at.x()) + any(-1, 1), recon::nearest_whole(1'000 * at.y()) + any(-1, 1));
    const recon::Vec2 point{alert::metres(fronts_[0].x), alert::metres(fronts_[0].y)};
    const float most = reach + alert::kFrontRadius;
    const bool expected = (robot.see(from + point) - place).squared_norm() < most * most;
    ASSERT_EQ(front_within(fronts_, origin, robot, place, reach), expected) << i;
    within += expected ? 1 : 0;
  }
  EXPECT_GT(within, 5'000);
  EXPECT_LT(within, 15'000);
}

TEST_F(Fronts, TheHysteresisHolds) {
  put(576, 0);
  EXPECT_EQ(see().held, AlertLevel::kClear);
  put(575, 0);
  EXPECT_EQ(see().due, AlertLevel::kClear);
  EXPECT_EQ(see().held, AlertLevel::kWarn);
  put(301, 0);
  EXPECT_EQ(see().held, AlertLevel::kWarn);
  put(299, 0);
  EXPECT_EQ(see().due, AlertLevel::kWarn);
  EXPECT_EQ(see().held, AlertLevel::kStop);
}

// At 0.5 m/s the body, 0.1 m to each side, is 0.8 s before contact at 0.5 m. The next frame is 0.05 m nearer.
TEST_F(Fronts, ComesSoonWhenTheRobotIsFast) {
  path_.motion.forward = 0.5F;
  put(501, 0);
  EXPECT_EQ(see().due, AlertLevel::kWarn);
  put(500, 0);
  EXPECT_EQ(see().due, AlertLevel::kStop);
  EXPECT_NEAR(see().nearest.ttc, (0.5F - 0.1F) / 0.5F, 1e-3F);
}

TEST_F(Fronts, WhatIsBehindMattersToARobotThatReverses) {
  put(-240, 0);
  EXPECT_EQ(see().due, AlertLevel::kClear);
  path_.motion.forward = -0.05F;
  EXPECT_EQ(see().due, AlertLevel::kStop);
  EXPECT_NEAR(std::fabs(see().nearest.bearing()), base::kPi, 1e-3F);
}

// Half the width is 0.1 m: ahead everything is 0.15 m farther, behind 0.2 m.
TEST_F(Fronts, ALongBodyMovesTheThresholds) {
  path_.front = 0.25F;
  path_.rear = 0.30F;
  put(413, 0);
  EXPECT_EQ(see().due, AlertLevel::kWarn);
  put(412, 0);
  EXPECT_EQ(see().due, AlertLevel::kStop);
  EXPECT_NEAR(see().nearest.distance, 0.412F, 1e-3F) << "from the origin, as ever";
  fronts_.clear();
  path_.motion.forward = -0.09F;
  put(-472, 0);
  EXPECT_EQ(see().due, AlertLevel::kWarn);
  put(-471, 0);
  EXPECT_EQ(see().due, AlertLevel::kStop);
  EXPECT_NEAR(see().nearest.ttc, (0.471F - 0.3F) / 0.09F, 1e-3F);
}

TEST_F(Fronts, WhatACornerHitsStops) {
  path_.front = 0.08F;
  path_.rear = 0.22F;
  put(-150, 150);
  EXPECT_EQ(see().due, AlertLevel::kClear) << "beside the tail, outside of the margin";
  path_.motion.turn = -0.6F;
  EXPECT_EQ(see().due, AlertLevel::kStop);
  path_.motion.forward = 0.15F;  // 0.25 m to the right
  EXPECT_EQ(see().due, AlertLevel::kStop);
  path_.motion.turn = 0.6F;
  EXPECT_EQ(see().due, AlertLevel::kClear);
}

// Three different frames: of one point, or of several that stand for one front.
TEST_F(Fronts, TakesThreeFrames) {
  put(240, 0, 0b1);
  put(240, 60, 0b1);
  put(245, -60, 0b10);
  put(230, -90, 0b11);
  EXPECT_EQ(see().due, AlertLevel::kClear);
  put(245, 30, 0b10000);
  EXPECT_EQ(see().due, AlertLevel::kStop);
}

// Thresholds see the robot, not the run's origin.
TEST_F(Fronts, AreSeenFromWhereTheRobotIs) {
  robot_.position = {300'000, -100'000};  // 3 m, -1 m
  robot_.heading = 1'570'796;
  put(3000, -1000 + 240, 0xFF, 4);
  const FrontAhead front = see();
  EXPECT_EQ(front.due, AlertLevel::kStop);
  EXPECT_NEAR(front.nearest.distance, 0.240F, 2e-3F);
  EXPECT_NEAR(front.nearest.bearing(), 0, 1e-2F);
  EXPECT_EQ(front.signature, 4);
  EXPECT_EQ(front.confidence, 1);
}

TEST_F(Fronts, TheNearestIsOneThatSeveralFramesHaveSeen) {
  put(400, 50, 0xFF, 1);
  put(380, -50, 0b1, 2);
  EXPECT_EQ(see().signature, 1);
  EXPECT_NEAR(see().nearest.distance, 0.403F, 2e-3F);
  fronts_[0].doubt = static_cast<std::uint8_t>(recon::guard::kRefutedAfter.raw / recon::guard::kDoubtTicks / 2);
  EXPECT_NEAR(see().confidence, 0.5F, 0.02F);
}

FrontAhead front_of(AlertLevel due, AlertLevel held) {
  FrontAhead front;
  front.due = due;
  front.held = held;
  front.nearest.known = true;
  return front;
}

class JudgeFront : public testing::Test {
 protected:
  std::optional<AlertLevel> at(int ms, AlertLevel due, AlertLevel held, AlertLevel others) {
    return judge(state_, front_of(due, held), others, alert::AlertRules(settings_), base::Time{ms * 10});
  }
  alert::AlertState state_;
  config::Settings settings_;
};

TEST_F(JudgeFront, SaysWhatNoObjectSays) {
  EXPECT_EQ(at(0, AlertLevel::kStop, AlertLevel::kStop, AlertLevel::kStop), std::nullopt);
  EXPECT_FALSE(state_.in_force());
  EXPECT_EQ(at(10, AlertLevel::kStop, AlertLevel::kStop, AlertLevel::kWarn), AlertLevel::kStop);
}

// Once said it stays, whatever the objects say, until the fronts themselves are farther.
TEST_F(JudgeFront, StaysUntilItEases) {
  EXPECT_EQ(at(0, AlertLevel::kWarn, AlertLevel::kWarn, AlertLevel::kClear), AlertLevel::kWarn);
  EXPECT_EQ(at(10, AlertLevel::kStop, AlertLevel::kStop, AlertLevel::kStop), std::nullopt);
  EXPECT_EQ(state_.level, AlertLevel::kWarn);
  for (int ms = 20; ms < 1000; ms += 10) {
    at(ms, AlertLevel::kWarn, AlertLevel::kWarn, AlertLevel::kStop);
    EXPECT_EQ(state_.level, AlertLevel::kWarn) << ms;
  }
  std::optional<AlertLevel> said;
  for (int ms = 1000; !said && ms < 2000; ms += 10) {
    said = at(ms, AlertLevel::kClear, AlertLevel::kClear, AlertLevel::kStop);
    if (said == AlertLevel::kWarn) said.reset();  // a repetition
    EXPECT_TRUE(!said || ms == 1300) << ms;
  }
  EXPECT_EQ(said, AlertLevel::kClear);
}

}  // namespace
}  // namespace fencepost::test
