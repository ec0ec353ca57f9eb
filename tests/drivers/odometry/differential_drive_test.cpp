#include "drivers/odometry/differential_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fencepost::odometry {
namespace {

constexpr base::Time at_ms(std::int64_t ms) { return {ms * 10}; }

/// 1 mm a count on both sides, 200 mm between the wheels, 16-bit counters.
constexpr WheelBase kPlain{kPicometresPerMillimetre, kPicometresPerMillimetre, 200 * kPicometresPerMillimetre, 16,
                           2'000};

TEST(WheelBase, FiguresOfTheCreate2) {
  // pi * 72 / 508.8 = 0.4445650... mm
  EXPECT_NEAR(static_cast<double>(kCreate2Wheels.left_pm_per_count), std::numbers::pi * 72e9 / 508.8, 0.51);
  EXPECT_EQ(kCreate2Wheels.right_pm_per_count / 100'000, 4'445);
  EXPECT_EQ(kCreate2Wheels.track_pm, 235 * kPicometresPerMillimetre);
  EXPECT_EQ(kCreate2Wheels.counter_bits, 16);
  // Pololu Romi: 12 * 3952/33 counts, 70 mm: 0.1530 mm a count.
  EXPECT_NEAR(static_cast<double>(per_count({70, 12.0 * 3952 / 33})), 0.1530e9, 0.0001e9);
  EXPECT_LT(per_count({56, -360}), 0) << "an encoder mounted the other way round";
}

TEST(DifferentialDrive, StartsAtTheOriginWhateverTheCountsAre) {
  DifferentialDrive drive(kPlain);
  EXPECT_EQ(drive.take(0x219, 60'000, at_ms(5)), (sensor::OdometrySample{at_ms(5), {0}, {0}, {0}}));
  EXPECT_EQ(drive.resets(), 0U);
}

// Right wheel 20 mm more than the left on a track of 200 mm: 0.1 rad to the left. Chord of 110 mm by 0.1 rad:
// 110 sin(0.05)/0.05 = 109.9542; along 0.05 rad: x = 109.8168, y = 5.4954.
TEST(DifferentialDrive, AnArcToTheLeft) {
  DifferentialDrive drive(kPlain);
  (void)drive.take(0, 0, at_ms(0));
  EXPECT_EQ(drive.take(100, 120, at_ms(100)), (sensor::OdometrySample{at_ms(100), {1'098}, {55}, {1'000}}));
}

TEST(DifferentialDrive, AWheelThatCountsDownGoesForward) {
  WheelBase wheels = kPlain;
  wheels.left_pm_per_count = -wheels.left_pm_per_count;
  DifferentialDrive drive(wheels);
  (void)drive.take(0, 0, at_ms(0));
  EXPECT_EQ(drive.take(0xFFFF - 99, 100, at_ms(100)).x.raw, 1'000);
}

TEST(DifferentialDrive, AResetOfOneEncoderIsNoTurn) {
  DifferentialDrive drive(kPlain);
  (void)drive.take(20'000, 20'000, at_ms(0));
  (void)drive.take(20'010, 20'010, at_ms(20));
  EXPECT_EQ(drive.take(0, 20'020, at_ms(40)), (sensor::OdometrySample{at_ms(40), {100}, {0}, {0}}));
  EXPECT_EQ(drive.resets(), 1U);
  EXPECT_EQ(drive.take(10, 20'030, at_ms(60)), (sensor::OdometrySample{at_ms(60), {200}, {0}, {0}}));
}

TEST(DifferentialDrive, ARebootThatIsKnownOfCostsItsMotionOnly) {
  DifferentialDrive drive(kPlain);
  (void)drive.take(100, 100, at_ms(0));
  (void)drive.take(150, 150, at_ms(100));
  drive.forget_counts();
  EXPECT_EQ(drive.take(0, 0, at_ms(200)).x.raw, 500) << "150 back to 0 would pass for a motion";
  EXPECT_EQ(drive.take(50, 50, at_ms(300)).x.raw, 1'000);
  EXPECT_EQ(drive.resets(), 0U);
}

TEST(DifferentialDrive, ASilenceIsBridgedByOneArc) {
  DifferentialDrive often(kPlain);
  DifferentialDrive seldom(kPlain);
  (void)often.take(0, 0, at_ms(0));
  (void)seldom.take(0, 0, at_ms(0));
  sensor::OdometrySample last;
  for (std::uint32_t i = 1; i <= 100; ++i) last = often.take(10 * i, 11 * i, at_ms(20 * static_cast<int>(i)));
  const sensor::OdometrySample once = seldom.take(1'000, 1'100, at_ms(2'000));
  EXPECT_NEAR(once.x.raw, last.x.raw, 1);
  EXPECT_NEAR(once.y.raw, last.y.raw, 1);
  EXPECT_EQ(once.heading, last.heading);
}

// 2000 mm/s are 2000 counts, and one for rounding: 0.9 s and 0.1 s of lateness allow 2002, a count of rounding
// included.
TEST(DifferentialDrive, CountsFasterThanTheWheelAreARestart) {
  for (const std::int64_t pm : {kPicometresPerMillimetre, -kPicometresPerMillimetre}) {
    WheelBase wheels = kPlain;
    wheels.left_pm_per_count = wheels.right_pm_per_count = pm;
    const std::int32_t sign = pm > 0 ? 1 : -1;
    DifferentialDrive most(wheels);
    (void)most.take(0, 0, at_ms(0));
    EXPECT_EQ(most.take(2'002, 2'002, at_ms(900)).x.raw, sign * 20'020);
    DifferentialDrive more(wheels);
    (void)more.take(0, 0, at_ms(0));
    EXPECT_EQ(more.take(2'003, 2'002, at_ms(900)).x.raw, 0);
    EXPECT_EQ(more.resets(), 1U);
    EXPECT_EQ(more.take(2'003, 4'005, at_ms(1'800)).x.raw, 0);
    EXPECT_EQ(more.resets(), 2U);
  }
}

// Whole radians and the rest: 2.1 m more on the right by 0.2 m are 10.5 rad.
TEST(DifferentialDrive, HeadingsOfManyRadians) {
  for (const std::int32_t sign : {1, -1}) {
    DifferentialDrive drive(kPlain);
    (void)drive.take(0, 0, at_ms(0));
    sensor::OdometrySample end;
    for (std::int32_t i = 1; i <= 21; ++i)
      end = drive.take(0, static_cast<std::uint32_t>(sign * 100 * i), at_ms(100 * i));
    EXPECT_NEAR(end.heading.raw, sign * std::lround(std::remainder(10.5, 2 * std::numbers::pi) * 1e4), 1);
  }
}

}  // namespace
}  // namespace fencepost::odometry
