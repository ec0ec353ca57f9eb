#include "firmware/alert/alerts.hpp"

#include <gtest/gtest.h>

namespace fencepost::test {
namespace {

using alert::AlertState;
using alert::Obstacle;
using record::AlertLevel;

Obstacle in_path(float distance) {
  Obstacle obstacle;
  obstacle.known = true;
  obstacle.in_path.emplace();
  obstacle.distance = distance;
  return obstacle;
}
Obstacle beside(float distance) {
  Obstacle obstacle = in_path(distance);
  obstacle.in_path.reset();
  return obstacle;
}
Obstacle closing(float distance, float ttc) {
  Obstacle obstacle = in_path(distance);
  obstacle.closing = true;
  obstacle.ttc = ttc;
  return obstacle;
}

TEST(AlertLevel, FollowsDistanceTimeAndPath) {
  const config::Settings defaults;
  const auto level = [&](const Obstacle& o) { return alert::level_for(o, alert::AlertRules(defaults), 1.0F); };
  EXPECT_EQ(level(in_path(1.01F)), AlertLevel::kClear);
  EXPECT_EQ(level(in_path(1.0F)), AlertLevel::kNotice);
  EXPECT_EQ(level(in_path(0.5F)), AlertLevel::kWarn);
  EXPECT_EQ(level(in_path(0.25F)), AlertLevel::kStop);
  EXPECT_EQ(level(closing(3.0F, 2.0F)), AlertLevel::kWarn);
  EXPECT_EQ(level(closing(3.0F, 0.8F)), AlertLevel::kStop);
  EXPECT_EQ(level(closing(3.0F, 2.1F)), AlertLevel::kClear);
  EXPECT_EQ(level(beside(0.51F)), AlertLevel::kClear);
  EXPECT_EQ(level(beside(0.1F)), AlertLevel::kNotice);  // near, but not in the way
  EXPECT_EQ(level(Obstacle{}), AlertLevel::kClear);
  Obstacle guessed = beside(0.1F);
  guessed.guessed = true;
  guessed.toward = {0.1F, 0.1F};
  EXPECT_EQ(level(guessed), AlertLevel::kNotice);
  guessed.toward = {-0.1F, 0.1F};
  EXPECT_EQ(level(guessed), AlertLevel::kClear) << "behind the robot nothing was ever seen";
  guessed.toward = {0, 0.1F};
  EXPECT_EQ(level(guessed), AlertLevel::kClear) << "nor beside it";
  Obstacle unbacked = in_path(0.1F);
  unbacked.guessed = true;
  unbacked.toward = {0.1F, 0};
  EXPECT_EQ(level(unbacked), AlertLevel::kStop);
  unbacked.unbacked = true;
  EXPECT_EQ(level(unbacked), AlertLevel::kNotice) << "the guard knows nothing there";
  unbacked.distance = 1.01F;
  EXPECT_EQ(level(unbacked), AlertLevel::kClear);
}

TEST(AlertLevel, DistancesAreMovedByTheOverhang) {
  const config::Settings defaults;
  const auto level = [&](Obstacle obstacle) {
    obstacle.overhang = 0.2F;
    return alert::level_for(obstacle, alert::AlertRules(defaults), 1.0F);
  };
  EXPECT_EQ(level(in_path(0.45F)), AlertLevel::kStop);
  EXPECT_EQ(level(in_path(0.70F)), AlertLevel::kWarn);
  EXPECT_EQ(level(in_path(0.71F)), AlertLevel::kNotice);
  EXPECT_EQ(level(in_path(1.21F)), AlertLevel::kClear);
  EXPECT_EQ(level(closing(3.0F, 2.1F)), AlertLevel::kClear) << "times know the body already";
}

TEST(AlertLevel, FollowsTheSettings) {
  config::Settings settings;
  ASSERT_FALSE(settings.set("alert.stop", "0.40").has_value());
  EXPECT_EQ(alert::level_for(in_path(0.39F), alert::AlertRules(settings), 1.0F), AlertLevel::kStop);
}

// 0.25 m: 3 sigmas of the object and of the robot itself, 4 mm, are taken off, at most a fifth of the stop distance.
TEST(AlertLevel, AStopAllowsForDoubt) {
  const config::Settings defaults;
  const auto level = [&](float distance, float sigma, bool cut_off) {
    Obstacle obstacle = in_path(distance);
    obstacle.in_path->sigma = sigma;
    obstacle.cut_off = cut_off;
    return alert::level_for(obstacle, alert::AlertRules(defaults), 1.0F);
  };
  EXPECT_EQ(level(0.261F, 0, false), AlertLevel::kStop);  // 0.012 m
  EXPECT_EQ(level(0.263F, 0, false), AlertLevel::kWarn);
  EXPECT_EQ(level(0.264F, 0.003F, false), AlertLevel::kStop);  // 3 sqrt(3^2 + 4^2) mm = 0.015 m
  EXPECT_EQ(level(0.266F, 0.003F, false), AlertLevel::kWarn);
  EXPECT_EQ(level(0.299F, 1, false), AlertLevel::kStop);  // at most 0.05 m
  EXPECT_EQ(level(0.301F, 1, false), AlertLevel::kWarn);
  EXPECT_EQ(level(0.269F, 0.003F, true), AlertLevel::kStop);  // an end was not seen: 4 sigmas, 0.020 m
  EXPECT_EQ(level(0.271F, 0.003F, true), AlertLevel::kWarn);
  EXPECT_EQ(level(0.349F, 1, true), AlertLevel::kStop);  // at most 0.10 m
  EXPECT_EQ(level(0.351F, 1, true), AlertLevel::kWarn);
}

// 0.3 m/s is 0.03 m in the 0.1 s until the next look. With the uncertainty of 0.012 m, 0.292 m is near enough.
TEST(AlertLevel, AStopComesBeforeTheNextLookWouldBeTooLate) {
  const config::Settings defaults;
  const auto level = [&](float distance) {
    Obstacle obstacle = closing(distance, 100);
    obstacle.closing_speed = 0.3F;
    return alert::level_for(obstacle, alert::AlertRules(defaults), 1.0F);
  };
  EXPECT_EQ(level(0.291F), AlertLevel::kStop);
  EXPECT_EQ(level(0.293F), AlertLevel::kWarn);
}

// Two centimetres nearer or farther, or another level.
TEST(NewAlert, IsWhatAPersonHasNotHeard) {
  AlertState state;
  record::AlertReport report;
  const auto is_new_to_person = [&](AlertLevel level, std::int32_t distance) {
    report.level = level;
    report.distance = {distance};
    return alert::is_new(state, report);
  };
  EXPECT_TRUE(is_new_to_person(AlertLevel::kWarn, 5'000));
  EXPECT_FALSE(is_new_to_person(AlertLevel::kWarn, 5'000));
  EXPECT_FALSE(is_new_to_person(AlertLevel::kWarn, 5'199));
  EXPECT_TRUE(is_new_to_person(AlertLevel::kWarn, 5'200));
  EXPECT_FALSE(is_new_to_person(AlertLevel::kWarn, 5'001)) << "of what was said last";
  EXPECT_TRUE(is_new_to_person(AlertLevel::kWarn, 5'000));
  EXPECT_TRUE(is_new_to_person(AlertLevel::kStop, 5'000));
  EXPECT_TRUE(is_new_to_person(AlertLevel::kWarn, 5'000));
}

class Judge : public testing::Test {
 protected:
  Judge() {
    object_.id = 7;
    object_.confirmed = true;
  }
  std::optional<AlertLevel> at(int ms, const Obstacle& obstacle) {
    return alert::judge(state_, object_, obstacle, alert::AlertRules(settings_), base::Time{ms * 10});
  }
  AlertState state_;
  recon::ObjectCore object_;
  config::Settings settings_;
};

TEST_F(Judge, SaysARiseAtOnce) {
  EXPECT_EQ(at(0, in_path(2)), std::nullopt);
  EXPECT_EQ(at(10, in_path(0.9F)), AlertLevel::kNotice);
  EXPECT_EQ(at(11, in_path(0.4F)), AlertLevel::kWarn);
  EXPECT_EQ(at(12, in_path(0.2F)), AlertLevel::kStop);
}

TEST_F(Judge, RepeatsWarnAndStopAtTheRateAndNoticeOnceASecond) {
  int stops = 0;
  for (int ms = 0; ms < 2000; ms += 10) stops += at(ms, in_path(0.2F)).has_value() ? 1 : 0;
  EXPECT_EQ(stops, 10);  // 5 a second
  state_ = {};
  int notices = 0;
  for (int ms = 2000; ms < 5000; ms += 10) notices += at(ms, in_path(0.9F)).has_value() ? 1 : 0;
  EXPECT_EQ(notices, 3);
}

TEST_F(Judge, EasesOnlyBeyondTheHysteresisAndOnlyIfItLasts) {
  EXPECT_EQ(at(0, in_path(0.25F)), AlertLevel::kStop);
  for (int ms = 10; ms < 190; ms += 10) EXPECT_EQ(at(ms, in_path(0.28F)), std::nullopt);  // within 15 %
  EXPECT_EQ(at(200, in_path(0.30F)), AlertLevel::kStop);  // the repeat: easing has begun only now
  EXPECT_EQ(at(300, in_path(0.24F)), std::nullopt);       // nearer again: no easing
  EXPECT_EQ(at(310, in_path(0.30F)), std::nullopt);
  EXPECT_EQ(at(400, in_path(0.30F)), AlertLevel::kStop);  // repeat
  EXPECT_EQ(at(600, in_path(0.30F)), AlertLevel::kStop);  // 0.29 s after 310: still a repeat
  EXPECT_EQ(at(610, in_path(0.30F)), AlertLevel::kWarn);
}

// A thing that the guard has lost below the image is still there.
TEST_F(Judge, WhatIsInForceNeedsNoBacking) {
  Obstacle unbacked = in_path(0.2F);
  unbacked.unbacked = true;
  EXPECT_EQ(at(0, unbacked), AlertLevel::kNotice);
  EXPECT_EQ(at(10, in_path(0.2F)), AlertLevel::kStop);
  for (int ms = 20; ms < 200; ms += 10) EXPECT_EQ(at(ms, unbacked), std::nullopt);
  EXPECT_EQ(at(210, unbacked), AlertLevel::kStop) << "the repeat";
  for (int ms = 220; ms < 2000; ms += 10) EXPECT_EQ(at(ms, unbacked).value_or(AlertLevel::kStop), AlertLevel::kStop);
}

TEST_F(Judge, SaysClearOnce) {
  EXPECT_EQ(at(0, in_path(0.9F)), AlertLevel::kNotice);
  EXPECT_EQ(at(100, in_path(2)), std::nullopt);
  EXPECT_EQ(at(400, in_path(2)), AlertLevel::kClear);
  for (int ms = 410; ms < 3000; ms += 10) EXPECT_EQ(at(ms, in_path(2)), std::nullopt);
}

TEST_F(Judge, UnconfirmedAndVanishedObjectsDoNotAlert) {
  object_.confirmed = false;
  EXPECT_EQ(at(0, in_path(0.1F)), std::nullopt);
  object_.confirmed = true;
  EXPECT_EQ(at(10, in_path(0.1F)), AlertLevel::kStop);
  object_.missed_for = static_cast<std::uint16_t>(recon::kMoment.raw);
  EXPECT_EQ(at(20, in_path(0.1F)), AlertLevel::kClear) << "it was missing for long enough";
  EXPECT_EQ(at(320, in_path(0.1F)), std::nullopt);
}

}  // namespace
}  // namespace fencepost::test
