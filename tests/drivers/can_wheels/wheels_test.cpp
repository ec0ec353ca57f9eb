#include "drivers/can_wheels/wheels.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <utility>

namespace fencepost::can_wheels {
namespace {

using sensor::LinkState;

base::Time at(std::int64_t ms) { return base::Time{ms * 10}; }

// Both counts, i16 little-endian, in one frame: 1 mm a count, 200 mm apart.
Mapping both_in_one() {
  Mapping mapping;
  mapping.left = {0x100, false, 0, 2, false, true};
  mapping.right = {0x100, false, 2, 2, false, true};
  mapping.wheels = {1'000'000'000, 1'000'000'000, 200'000'000'000, 16};
  return mapping;
}

bus::CanFrame pair(int left, int right) {
  bus::CanFrame frame;
  frame.id = 0x100;
  frame.length = 4;
  frame.data = {static_cast<std::uint8_t>(left & 0xFF), static_cast<std::uint8_t>(left >> 8 & 0xFF),
                static_cast<std::uint8_t>(right & 0xFF), static_cast<std::uint8_t>(right >> 8 & 0xFF)};
  return frame;
}

TEST(CanWheels, CountsInOneFrame) {
  Wheels wheels(both_in_one());
  ASSERT_TRUE(wheels.take(pair(100, 100), at(20)));
  const auto sample = wheels.take(pair(110, 110), at(40));
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->t, at(40));
  EXPECT_EQ(sample->x.raw, 100);  // 10 mm
  EXPECT_EQ(wheels.link(at(40)), LinkState::kOk);
}

TEST(CanWheels, ARestartIsNoWayASilenceIs) {
  Wheels wheels(both_in_one());
  (void)wheels.take(pair(300, 300), at(0));
  EXPECT_EQ(wheels.take(pair(310, 310), at(20))->x.raw, 100);
  EXPECT_EQ(wheels.take(pair(500, 500), at(520))->x.raw, 2'000);  // half a second of silence: 190 counts on
  EXPECT_EQ(wheels.take(pair(3, 3), at(1'020))->x.raw, 2'000);    // restarted
  EXPECT_EQ(wheels.take(pair(13, 13), at(1'040))->x.raw, 2'100);
  EXPECT_EQ(wheels.take(pair(3, 3), at(1'060))->x.raw, 2'000);  // back, too soon for a restart
}

TEST(CanWheels, AReversedWheelHasANegativeScale) {
  Mapping mapping = both_in_one();
  mapping.wheels.right_pm_per_count = -1'000'000'000;
  Wheels wheels(mapping);
  (void)wheels.take(pair(0, 0), at(20));
  EXPECT_EQ(wheels.take(pair(10, -10), at(40))->x.raw, 100);
}

// 10 units of 1 mm/s on one side, 30 on the other, for one second: 20 mm on, (30 - 10)/200 = 0.1 rad round.
TEST(CanWheels, VelocitiesAreIntegrated) {
  Mapping mapping = both_in_one();
  mapping.quantity = Quantity::kVelocities;
  Wheels wheels(mapping);
  sensor::OdometrySample last;
  for (int ms = 0; ms <= 1'000; ms += 20) last = *wheels.take(pair(10, 30), at(ms));
  EXPECT_EQ(last.heading.raw, 1'000);
  EXPECT_NEAR(last.x.to_double(), 0.02, 0.0001);
  EXPECT_NEAR(last.y.to_double(), 0.001, 0.0001);
}

// From 0 to 100 mm/s within 100 ms: the mean is 50.
TEST(CanWheels, ByTrapezoids) {
  Mapping mapping = both_in_one();
  mapping.quantity = Quantity::kVelocities;
  Wheels wheels(mapping);
  (void)wheels.take(pair(0, 0), at(0));
  EXPECT_EQ(wheels.take(pair(100, 100), at(100))->x.raw, 50);
  // After a long silence nothing is assumed.
  EXPECT_EQ(wheels.take(pair(100, 100), at(2'000))->x.raw, 50);
}

TEST(CanWheels, ImpossibleVelocitiesAreMalformed) {
  Mapping mapping = both_in_one();
  mapping.quantity = Quantity::kVelocities;
  Wheels wheels(mapping);
  EXPECT_TRUE(wheels.take(pair(2'000, 2'000), at(0)));
  EXPECT_FALSE(wheels.take(pair(2'001, 0), at(20)));
  EXPECT_FALSE(wheels.take(pair(0, -2'001), at(40)));
  EXPECT_EQ(wheels.counters().malformed, 2U);
}

TEST(CanWheels, AVelocityLastsHalfASecondAtMost) {
  Mapping mapping = both_in_one();
  mapping.quantity = Quantity::kVelocities;
  for (const auto& [ms, x] : {std::pair(500, 500), {501, 0}}) {
    Wheels wheels(mapping);
    (void)wheels.take(pair(100, 100), at(0));
    EXPECT_EQ(wheels.take(pair(100, 100), at(ms))->x.raw, x) << ms;
  }
  Wheels wheels(mapping);
  (void)wheels.take(pair(-100, -100), at(0));
  EXPECT_EQ(wheels.take(pair(-100, -100), at(100))->x.raw, -100);
}

// No controller restarts within 200 ms; and its counts are then nearer to zero than to what they were.
TEST(CanWheels, WhatIsARestart) {
  for (const auto& [ms, count, x] : {std::tuple(199, 4, -60), {200, 4, 0}, {200, 5, -50}, {200, 6, -40}}) {
    Wheels wheels(both_in_one());
    (void)wheels.take(pair(10, 10), at(0));
    EXPECT_EQ(wheels.take(pair(count, count), at(ms))->x.raw, x) << ms << ' ' << count;
  }
  Wheels backwards(both_in_one());
  (void)backwards.take(pair(-10, -10), at(0));
  EXPECT_EQ(backwards.take(pair(-4, -4), at(200))->x.raw, 0);
}

TEST(CanWheels, IsHeardForAsLongAsItsMappingSays) {
  Mapping mapping = both_in_one();
  mapping.silence = base::milliseconds(300);
  Wheels wheels(mapping);
  (void)wheels.take(pair(0, 0), at(0));
  EXPECT_EQ(wheels.link(at(300)), LinkState::kOk);
  EXPECT_EQ(wheels.link(at(301)), LinkState::kSilent);
  wheels.forget();
  EXPECT_EQ(wheels.link(at(0)), LinkState::kSilent);
}

TEST(CanWheels, AFrameOfEitherKindOrOfNoneIsAnothers) {
  Wheels wheels(both_in_one());
  bus::CanFrame extended = pair(1, 1);
  extended.extended = true;
  bus::CanFrame remote = pair(1, 1);
  remote.remote = true;
  EXPECT_FALSE(wheels.take(extended, at(1)));
  EXPECT_FALSE(wheels.take(remote, at(2)));
  EXPECT_EQ(wheels.counters().unrelated, 2U);
  EXPECT_TRUE(wheels.take(pair(1, 1), at(3)));
}

TEST(CanWheels, OneWheelAloneIsUnready) {
  Mapping mapping = both_in_one();
  mapping.right.id = 0x101;
  Wheels wheels(mapping);
  EXPECT_EQ(wheels.link(at(0)), LinkState::kSilent);
  for (int ms = 20; ms < 200; ms += 20) EXPECT_FALSE(wheels.take(pair(ms, 0), at(ms)));
  EXPECT_EQ(wheels.link(at(200)), LinkState::kUnready);
  EXPECT_EQ(wheels.link(at(600)), LinkState::kSilent);
}

TEST(CanWheels, ForeignAndShortFramesAreCounted) {
  Wheels wheels(both_in_one());
  bus::CanFrame unrelated = pair(1, 1);
  unrelated.id = 0x7FF;
  EXPECT_FALSE(wheels.take(unrelated, at(1)));
  bus::CanFrame cut = pair(1, 1);
  cut.length = 3;
  EXPECT_FALSE(wheels.take(cut, at(2)));
  EXPECT_EQ(wheels.counters().unrelated, 1U);
  EXPECT_EQ(wheels.counters().malformed, 1U);
  EXPECT_EQ(wheels.counters().frames, 1U);
}

}  // namespace
}  // namespace fencepost::can_wheels
