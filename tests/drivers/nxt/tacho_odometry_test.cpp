#include "drivers/nxt/tacho_odometry.hpp"

#include <gtest/gtest.h>

#include "drivers/nxt/brick.hpp"
#include "tests/drivers/nxt/emulated_usb.hpp"

namespace fencepost::nxt {
namespace {

using sensor::LinkState;

struct Bench {
  explicit Bench(const TachoOptions& options = {}) : odometry(brick.conversation(), options) {}

  fake::SteppedClock clock;
  emulate::NxtBrick device{base::Time{}};
  test::EmulatedUsb link{device, clock};
  Brick<test::EmulatedUsb> brick{link};
  TachoOdometry odometry;
  std::vector<sensor::OdometrySample> samples;
  double left = 0;
  double right = 0;

  // Degrees a second of both motors.
  void run(std::int64_t ms, double left_rate, double right_rate) {
    for (std::int64_t i = 0; i < ms; ++i) {
      clock.advance(base::milliseconds(1));
      left += left_rate * 1e-3;
      right += right_rate * 1e-3;
      device.turn(1, static_cast<std::int32_t>(left));
      device.turn(2, static_cast<std::int32_t>(right));
      brick.poll(clock.now());
      if (const auto sample = odometry.poll(clock.now())) samples.push_back(*sample);
    }
  }
};

// 360 degrees of a 56 mm wheel are 175.93 mm.
TEST(NxtTachoOdometry, DrivesStraight) {
  Bench bench;
  bench.run(4'000, 0, 0);
  EXPECT_EQ(bench.odometry.link(), LinkState::kOk);
  bench.run(5'000, 360, 360);
  bench.run(200, 0, 0);
  ASSERT_FALSE(bench.samples.empty());
  EXPECT_NEAR(bench.samples.back().x.to_double(), 5 * 0.17593, 0.001);
  EXPECT_NEAR(bench.samples.back().y.to_double(), 0, 0.002);
  EXPECT_NEAR(bench.samples.back().heading.to_double(), 0, 0.005);
}

// Both wheels opposite, 360 degrees each: 2 x 175.93 mm on a track of 112 mm are 3.1416 rad.
TEST(NxtTachoOdometry, TurnsOnTheSpot) {
  Bench bench;
  bench.run(4'000, 0, 0);
  bench.run(500, -360, 360);
  bench.run(200, 0, 0);
  EXPECT_NEAR(bench.samples.back().heading.to_double(), 3.1416 / 2, 0.02);
  EXPECT_NEAR(bench.samples.back().x.to_double(), 0, 0.002);
}

// Driving straight over a slow link: the readings are 40 ms apart, at 360 degrees a second 14 counts; without the
// interpolation the robot would seem to have turned by 14 x 0.489 mm / 112 mm = 0.06 rad.
TEST(NxtTachoOdometry, ReadingsAtDifferentTimesAreNoTurn) {
  Bench bench;
  bench.link.delay = base::milliseconds(40);
  bench.run(4'000, 0, 0);
  bench.run(2'000, 360, 360);
  for (const sensor::OdometrySample& sample : bench.samples) {
    EXPECT_LT(std::abs(sample.heading.to_double()), 0.035);
  }
  const sensor::OdometrySample& last = bench.samples.back();
  EXPECT_LT(std::abs(last.heading.to_double()), 0.01);
}

TEST(NxtTachoOdometry, SamplesComeAtTheirPeriodInOrder) {
  Bench bench;
  bench.run(4'000, 0, 0);
  bench.samples.clear();
  bench.run(2'000, 100, 100);
  EXPECT_NEAR(static_cast<double>(bench.samples.size()), 100, 4);
  for (std::size_t i = 1; i < bench.samples.size(); ++i) EXPECT_GT(bench.samples[i].t, bench.samples[i - 1].t);
}

TEST(NxtTachoOdometry, ARestartOfTheBrickIsNoMotion) {
  Bench bench;
  bench.run(4'000, 0, 0);
  bench.run(1'000, 360, 360);
  bench.run(100, 0, 0);
  const sensor::OdometrySample before = bench.samples.back();
  bench.device.restart(bench.clock.now());
  bench.run(2'000, 0, 0);
  EXPECT_EQ(bench.odometry.link(), LinkState::kSilent);
  bench.run(3'000, 0, 0);
  EXPECT_EQ(bench.odometry.link(), LinkState::kOk);
  EXPECT_GT(bench.samples.back().t, before.t);
  EXPECT_EQ(bench.samples.back().x, before.x);
  bench.run(1'000, 360, 360);
  bench.run(100, 0, 0);
  EXPECT_NEAR(bench.samples.back().x.to_double(), before.x.to_double() + 0.17593, 0.002);
}

TEST(NxtTachoOdometry, AWrongPortIsUnready) {
  Bench bench({.left_port = 7});
  bench.run(5'000, 0, 0);
  EXPECT_EQ(bench.odometry.link(), LinkState::kUnready);
  EXPECT_TRUE(bench.samples.empty());
}

TEST(NxtTachoOdometry, UnpluggedIsAbsent) {
  Bench bench;
  bench.run(4'000, 0, 0);
  bench.link.unplugged = true;
  bench.run(100, 0, 0);
  EXPECT_EQ(bench.odometry.link(), LinkState::kAbsent);
}

}  // namespace
}  // namespace fencepost::nxt
