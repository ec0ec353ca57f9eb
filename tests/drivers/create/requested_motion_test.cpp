// A Create 1's path between its readings: exact numbers at each bound.
#include "drivers/create/requested_motion.hpp"

#include <gtest/gtest.h>

namespace fencepost::create {
namespace {

constexpr std::int64_t kTrack = 258'000'000'000;  // pm

/// Drives with both wheels so many 0.1 um, at most 10 m/s for 0.1 s, then reads.
struct Robot {
  RequestedMotion motion{kTrack};
  base::Time t{};

  // 0.1 ms at so many mm/s are so many 0.1 um.
  void go(std::int32_t left, std::int32_t right) {
    motion.request(left, right, t);
    t = t + base::Duration{1};
    motion.request(left, right, t);
  }
  void read(std::int32_t mm, std::int32_t degrees, bool in_part = false) { motion.read({mm, degrees, in_part}); }
  [[nodiscard]] std::int32_t x() const { return motion.sample(t).x.raw; }  // 0.1 mm, 1,000 of 0.1 um
  [[nodiscard]] std::int32_t heading() const { return motion.sample(t).heading.raw; }
};

// A reading of 1 mm means 1 to 2 mm. A prediction off by up to a quarter of a millimetre is set to that end, else to
// the middle.
TEST(RequestedMotion, AReadingOfWholeMillimetresLimitsWhatWasPredicted) {
  const struct {
    std::int32_t predicted, told, x;
  } cases[] = {{7'500, 1, 10},     {7'499, 1, 15},     {10'000, 1, 10},   {13'000, 1, 13},   {20'000, 1, 20},
               {22'500, 1, 20},    {22'501, 1, 15},    {-7'500, -1, -10}, {-7'499, -1, -15}, {-13'000, -1, -13},
               {-22'500, -1, -20}, {-22'501, -1, -15}, {0, 0, 0},         {-10'000, 0, -10}, {10'000, 0, 10},
               {12'500, 0, 10},    {12'501, 0, 0},     {-12'500, 0, -10}, {-12'501, 0, 0},   {0, 5, 55},
               {0, -5, -55}};
  for (const auto& [predicted, told, x] : cases) {
    Robot robot;
    robot.go(predicted, predicted);
    EXPECT_EQ(robot.x(), base::Time{predicted}.raw / 1'000 + (predicted % 1'000 >= 500) - (predicted % 1'000 <= -500));
    robot.read(told, 0);
    EXPECT_EQ(robot.x(), x) << predicted << " read " << told;
  }
}

TEST(RequestedMotion, WhatIsInPartAddsOnly) {
  const struct {
    std::int32_t predicted, told, x;
  } cases[] = {{30'000, 1, 30}, {30'000, 5, 55}, {-30'000, -1, -30}, {-30'000, -5, -55}, {0, 5, 55}, {0, -5, -55}};
  for (const auto& [predicted, told, x] : cases) {
    Robot robot;
    robot.go(predicted, predicted);
    robot.read(told, 0, true);
    EXPECT_EQ(robot.x(), x) << predicted << " read " << told;
    EXPECT_EQ(robot.heading(), 0);
  }
  Robot turned;  // 2 x 60,000 by 258 mm: 0.0465 rad, 2.66 degrees
  turned.go(-60'000, 60'000);
  EXPECT_EQ(turned.heading(), 465);
  turned.read(0, 1, true);
  EXPECT_EQ(turned.heading(), 465);
  turned.go(0, 0);
  turned.read(0, 1, true);
  EXPECT_EQ(turned.heading(), 465 + 262) << "1.5 degrees more";
  turned.read(0, -1, true);
  EXPECT_EQ(turned.heading(), 465);
}

// 3 mm are no surprise yet. A reading of 3 has its middle at 3.5 mm; -3, the same behind.
TEST(RequestedMotion, MoreThanThreeMillimetresOffAreASurprise) {
  for (const std::int32_t sign : {1, -1}) {
    for (const auto& [predicted, surprises] : {std::pair(5'000, 0U), {4'999, 1U}}) {
      Robot robot;
      robot.go(sign * predicted, sign * predicted);
      robot.read(sign * 3, 0);
      EXPECT_EQ(robot.motion.surprises(), surprises) << sign * predicted;
      EXPECT_EQ(robot.motion.interval(), surprises == 0 ? RequestedMotion::kUsual : RequestedMotion::kSurprised);
      robot.go(0, 0);
      robot.read(0, 0);
      EXPECT_EQ(robot.motion.interval(), RequestedMotion::kUsual) << "as requested again";
    }
  }
}

// Half a degree of 3.5 degrees: 8727 urad are 2 x 11,258 by 258 mm.
TEST(RequestedMotion, MoreThanThreeDegreesOffAreASurprise) {
  for (const std::int32_t sign : {1, -1}) {
    for (const auto& [wheel, surprises] : {std::pair(11'258, 0U), {11'257, 1U}}) {
      Robot robot;
      robot.go(-sign * wheel, sign * wheel);
      robot.read(0, sign * 3);
      EXPECT_EQ(robot.motion.surprises(), surprises) << sign * wheel;
      EXPECT_EQ(robot.heading(), sign * 611) << "3.5 degrees";
      EXPECT_EQ(robot.x(), 0);
    }
  }
}

TEST(RequestedMotion, BetweenTwoRequestsTheWheelsHaveTheirMean) {
  RequestedMotion motion(kTrack);
  motion.request(100, 300, base::Time{});
  EXPECT_EQ(motion.sample({}).x.raw, 0) << "the first says where it begins";
  motion.request(300, 500, base::Time{} + base::milliseconds(100));
  EXPECT_EQ(motion.sample({}).x.raw, 300) << "300 mm/s for 0.1 s";
  EXPECT_EQ(motion.sample({}).heading.raw, 775) << "200 mm/s more on the right: 20 mm by 258 mm";
  motion.request(300, 500, base::Time{} + base::milliseconds(100));
  EXPECT_EQ(motion.sample({}).x.raw, 300) << "no time has passed";
  motion.request(0, 0, base::Time{} + base::milliseconds(50));
  EXPECT_EQ(motion.sample({}).x.raw, 300) << "nor backwards";
}

TEST(RequestedMotion, NobodyKnowsWhatAWheelDidForMoreThanATenthOfASecond) {
  for (const std::int64_t ms : {100, 101, 5'000}) {
    RequestedMotion motion(kTrack);
    motion.request(200, 200, base::Time{});
    motion.request(200, 200, base::Time{} + base::milliseconds(ms));
    EXPECT_EQ(motion.sample({}).x.raw, 200) << ms;
  }
}

TEST(RequestedMotion, ASkippedReadingLeavesWhatWasPredicted) {
  Robot robot;
  robot.go(0, 60'000);
  const std::int32_t x = robot.x();
  const std::int32_t heading = robot.heading();
  EXPECT_EQ(heading, 233) << "6 mm by 258 mm";
  robot.motion.skip_reading();
  robot.read(0, 0);
  EXPECT_EQ(robot.x(), x);
  EXPECT_EQ(robot.heading(), heading);
  EXPECT_EQ(robot.motion.surprises(), 0U);
}

}  // namespace
}  // namespace fencepost::create
