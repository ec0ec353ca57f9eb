#include "drivers/odometry/wheel_pairs.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace fencepost::odometry {
namespace {

// 1 mm a count, 100 mm apart, 16 bits.
constexpr WheelBase kWheels = {1'000'000'000, 1'000'000'000, 100'000'000'000, 16};

base::Time at(std::int64_t ms) { return base::Time{ms * 10}; }

TEST(WheelPairs, LeftIsInterpolatedAtTheTimeOfRight) {
  WheelPairs pairs(kWheels);
  EXPECT_FALSE(pairs.take_left(0, at(0)));
  pairs.take_right(100, at(15));
  EXPECT_TRUE(pairs.take_left(20, at(20)));  // the start: left 15, right 100
  pairs.take_right(120, at(35));
  const auto sample = pairs.take_left(40, at(40));  // left 35
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->t, at(35));
  EXPECT_EQ(sample->x.raw, 200);
  EXPECT_EQ(sample->heading.raw, 0);
}

TEST(WheelPairs, SilenceMakesNoPair) {
  WheelPairs pairs(kWheels);
  (void)pairs.take_left(0, at(0));
  EXPECT_FALSE(pairs.take_left(5, at(10)));  // no right one between
  pairs.take_right(5, at(15));
  EXPECT_FALSE(pairs.take_left(5, at(511)));
  pairs.take_right(5, at(512));
  pairs.forget();
  EXPECT_FALSE(pairs.take_left(5, at(520)));
}

TEST(WheelPairs, ReadingsHalfASecondApartAtMost) {
  for (const auto& [apart, pair] : {std::pair(500, true), {501, false}}) {
    WheelPairs pairs(kWheels);
    (void)pairs.take_left(0, at(0));
    pairs.take_right(5, at(apart / 2));
    EXPECT_EQ(pairs.take_left(5, at(apart)).has_value(), pair) << apart;
  }
}

TEST(WheelPairs, ARightOneFromBeforeTheLeftMakesNoPair) {
  WheelPairs pairs(kWheels);
  (void)pairs.take_left(0, at(10));
  pairs.take_right(5, at(9));
  EXPECT_FALSE(pairs.take_left(5, at(20)));
  pairs.take_right(5, at(20));
  EXPECT_TRUE(pairs.take_left(10, at(30))) << "at the same time is one";
}

// Both left ones at one time: the later count stands. Before 0, halves are rounded away from it.
TEST(WheelPairs, LeftIsInterpolatedToTheNearestCount) {
  WheelPairs pairs(kWheels);
  (void)pairs.take_left(0, at(0));
  pairs.take_right(0, at(0));
  EXPECT_TRUE(pairs.take_left(20, at(0)));
  pairs.take_right(20, at(20));
  auto sample = pairs.take_left(40, at(20));  // left 40: 20 more than before, right 20 more
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->x.raw, 200);
  EXPECT_EQ(sample->heading.raw, 0);
  pairs.take_right(20, at(30));
  sample = pairs.take_left(35, at(40));  // 2.5 counts back, which are 3
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->x.raw, 200 - 15);
}

}  // namespace
}  // namespace fencepost::odometry
