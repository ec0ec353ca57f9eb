#include "drivers/nxt/tacho_odometry.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/bench/nxt_rig.hpp"

namespace fencepost::nxt {
namespace {

using sensor::LinkState;

struct TachoBench : test::Bench<test::NxtWheelsRig<test::UsbBrick>> {
  explicit TachoBench(const TachoOptions& options = {})
      : test::Bench<test::NxtWheelsRig<test::UsbBrick>>(test::Damage{}, options) {}
  // Degrees a second of both motors.
  void run(std::int64_t ms, double left_degrees, double right_degrees) {
    left_rate = left_degrees;
    right_rate = right_degrees;
    (void)test::Bench<test::NxtWheelsRig<test::UsbBrick>>::run(ms);
  }
};

// 360 degrees of a 56 mm wheel are 175.93 mm.
TEST(NxtTachoOdometry, DrivesStraight) {
  TachoBench bench;
  bench.run(4'000, 0, 0);
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  bench.run(5'000, 360, 360);
  bench.run(200, 0, 0);
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_NEAR(bench.frames.back().x.to_double(), 5 * 0.17593, 0.001);
  EXPECT_NEAR(bench.frames.back().y.to_double(), 0, 0.002);
  EXPECT_NEAR(bench.frames.back().heading.to_double(), 0, 0.005);
}

// Both wheels opposite, 360 degrees each: 2 x 175.93 mm on a track of 112 mm are 3.1416 rad.
TEST(NxtTachoOdometry, TurnsOnTheSpot) {
  TachoBench bench;
  bench.run(4'000, 0, 0);
  bench.run(500, -360, 360);
  bench.run(200, 0, 0);
  EXPECT_NEAR(bench.frames.back().heading.to_double(), 3.1416 / 2, 0.02);
  EXPECT_NEAR(bench.frames.back().x.to_double(), 0, 0.002);
}

// Driving straight over a slow link: the readings are 40 ms apart, at 360 degrees a second 14 counts. Without the
// interpolation the robot would seem to have turned by 14 x 0.489 mm / 112 mm = 0.06 rad.
TEST(NxtTachoOdometry, ReadingsAtDifferentTimesAreNoTurn) {
  TachoBench bench;
  bench.link.delay = base::milliseconds(40);
  bench.run(4'000, 0, 0);
  bench.run(2'000, 360, 360);
  for (const sensor::OdometrySample& sample : bench.frames) {
    EXPECT_LT(std::abs(sample.heading.to_double()), 0.035);
  }
  const sensor::OdometrySample& last = bench.frames.back();
  EXPECT_LT(std::abs(last.heading.to_double()), 0.01);
}

TEST(NxtTachoOdometry, ARestartOfTheBrickIsNoMotion) {
  TachoBench bench;
  bench.run(4'000, 0, 0);
  bench.run(1'000, 360, 360);
  bench.run(100, 0, 0);
  const sensor::OdometrySample before = bench.frames.back();
  bench.device.restart(bench.clock.now());
  bench.run(2'000, 0, 0);
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  bench.run(3'000, 0, 0);
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  EXPECT_GT(bench.frames.back().t, before.t);
  EXPECT_EQ(bench.frames.back().x, before.x);
  bench.run(1'000, 360, 360);
  bench.run(100, 0, 0);
  EXPECT_NEAR(bench.frames.back().x.to_double(), before.x.to_double() + 0.17593, 0.002);
}

TEST(NxtTachoOdometry, AWrongPortIsUnready) {
  TachoBench bench({.left_port = 7});
  bench.run(5'000, 0, 0);
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);
  EXPECT_TRUE(bench.frames.empty());
}

}  // namespace
}  // namespace fencepost::nxt
