// The largest speed from which the robot still stops, against the levels that are due at it.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "firmware/alert/front_alert.hpp"

namespace fencepost::test {
namespace {

using alert::Obstacle;
using record::AlertLevel;

// 0.8 s to the contact and 0.4 s to slow down in: 0.6 m / 1.2 s. Near alert.stop, 0.1 s until the path is watched
// again.
TEST(StoppingSpeed, LeavesTimeToSlowDownAndEndsAtTheStopDistance) {
  EXPECT_FLOAT_EQ(alert::stopping_speed(0.6F, 0.8F, 0.5F), 0.5F);
  EXPECT_FLOAT_EQ(alert::stopping_speed(0.2F, 0.8F, 0.01F), 0.1F);
  EXPECT_EQ(alert::stopping_speed(0.2F, 0.8F, 0), 0);
  EXPECT_EQ(alert::stopping_speed(0.2F, 0.8F, -0.1F), 0);
  EXPECT_EQ(alert::stopping_speed(-0.2F, 0.8F, 1), 0);
}

class RandomObstacles : public testing::Test {
 protected:
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  alert::RobotPath path() {
    alert::RobotPath path;
    if (between(0, 1) < 0.5F) path.front = between(0.1F, 0.4F);
    return path;
  }
  // Somewhere ahead in the path of a robot that drives straight on.
  Obstacle obstacle(const alert::RobotPath& path) {
    Obstacle obstacle;
    obstacle.known = true;
    obstacle.toward = {between(0.05F, 2), between(-0.2F, 0.2F)};
    obstacle.distance = std::max(0.0F, obstacle.toward.norm() - between(0, 0.1F));
    obstacle.cut_off = between(0, 1) < 0.3F;
    obstacle.overhang = path.front > path.body_radius ? path.front - path.body_radius : 0;
    obstacle.in_path = alert::InPath{between(0, 0.03F)};
    return obstacle;
  }
  static AlertLevel level_at(float speed, Obstacle obstacle, alert::RobotPath path, const alert::AlertRules& rules) {
    path.motion.forward = speed;
    alert::set_closing(path, obstacle);
    return level_for(obstacle, rules, 1.0F);
  }
  std::mt19937 random_{29};
};

TEST_F(RandomObstacles, NoStopIsDueAtItAndSomewhatFasterOneIs) {
  const alert::AlertRules rules{config::Settings{}};
  const float later = (rules.ttc_stop + alert::kSlowsWithin) / rules.ttc_stop;
  int standing = 0;
  for (int i = 0; i < 5'000; ++i) {
    const alert::RobotPath robot = path();
    const Obstacle one = obstacle(robot);
    const float speed = stopping_speed(one, robot, rules);
    if (level_at(0, one, robot, rules) == AlertLevel::kStop) {
      EXPECT_EQ(speed, 0) << i;
      ++standing;
      continue;
    }
    EXPECT_LT(level_at(0.99F * speed, one, robot, rules), AlertLevel::kStop) << i;
    EXPECT_EQ(level_at(1.01F * later * speed + 0.01F, one, robot, rules), AlertLevel::kStop) << i;
  }
  EXPECT_GT(standing, 200);
}

// Of two obstacles that differ in the distance alone, the nearer one has the higher level and the lower speed.
TEST_F(RandomObstacles, ItIsNeverLargerWhereTheLevelIsHigher) {
  const alert::AlertRules rules{config::Settings{}};
  for (int i = 0; i < 2'000; ++i) {
    const alert::RobotPath robot = path();
    Obstacle one = obstacle(robot);
    const float driven = between(0, 0.6F);
    float before = 0;
    AlertLevel level_before = AlertLevel::kBlind;
    for (one.distance = 0; one.distance < 2; one.distance += 0.05F) {
      const float speed = stopping_speed(one, robot, rules);
      const AlertLevel level = level_at(driven, one, robot, rules);
      EXPECT_GE(speed, before) << i;
      EXPECT_LE(level, level_before) << i;
      before = speed;
      level_before = level;
    }
  }
}

TEST(StoppingSpeed, OnlyWhatIsInThePathLimitsIt) {
  const alert::AlertRules rules{config::Settings{}};
  Obstacle beside;
  beside.known = true;
  beside.toward = {0.3F, 0.3F};
  beside.distance = 0.3F;
  EXPECT_EQ(stopping_speed(beside, {}, rules), alert::kFastest);
  beside.in_path.emplace();
  EXPECT_LT(stopping_speed(beside, {}, rules), 0.5F);
  beside.unbacked = true;
  EXPECT_EQ(stopping_speed(beside, {}, rules), alert::kFastest) << "worth no more than a notice";
}

// The same of the guard's points: several frames have to agree.
TEST(StoppingSpeed, TheGuardsPointsLimitIt) {
  const alert::AlertRules rules{config::Settings{}};
  alert::RobotPath path;
  const auto at = [&](int x, int y, unsigned frames, float speed) {
    path.motion.forward = speed;
    const recon::guard::Front front{
        static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::uint8_t>(frames), 0, 0, 1};
    return see_fronts({&front, 1}, {}, alert::RobotPlace(recon::MapPose{}), path, rules);
  };
  for (const int x : {300, 400, 700, 1'200}) {
    const float speed = at(x, 0, 0xFF, 0).speed;
    EXPECT_LT(at(x, 0, 0xFF, 0.99F * speed).due, AlertLevel::kStop) << x;
    EXPECT_EQ(at(x, 0, 0xFF, 1.6F * speed + 0.02F).due, AlertLevel::kStop) << x;
  }
  EXPECT_EQ(at(700, 300, 0xFF, 0.2F).speed, at(700, 400, 0xFF, 0.2F).speed) << "beside the path";
  EXPECT_GT(at(700, 300, 0xFF, 0.2F).speed, 2);
  EXPECT_GT(at(400, 0, 0x01, 0.2F).speed, 2) << "a single frame may be noise";
  EXPECT_EQ(at(240, 0, 0xFF, 0).speed, 0);
}

}  // namespace
}  // namespace fencepost::test
