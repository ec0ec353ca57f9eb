// Encoders as odometry: no emulator turns a wheel, so the counters are played.
#include "firmware/image/odometry/encoders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fencepost::image {
namespace {

constexpr double kRevolution = 0.065 * std::numbers::pi;  // m, of the wheel in firmware/config/devices.hpp
constexpr std::uint32_t kCounts = 1'440;                  // a revolution

class EncodersTest : public ::testing::Test {
 protected:
  EncodersTest() {
    board::counters = {};
    Encoders::start(opening);
  }
  /// 20 ms pass; then both wheels stand at these counts.
  sensor::OdometrySample at(std::uint32_t left, std::uint32_t right) {
    board::counters.left = left;
    board::counters.right = right;
    now_ = now_ + base::milliseconds(20);
    const auto sample = odometry.poll(now_);
    EXPECT_TRUE(sample);
    return *sample;
  }
  /// In steps that a wheel can do.
  sensor::OdometrySample roll(std::int32_t left, std::int32_t right) {
    sensor::OdometrySample sample;
    constexpr int kSteps = 90;
    for (int i = 1; i <= kSteps; ++i) {
      sample = at(left_ + static_cast<std::uint32_t>(left * i / kSteps),
                  right_ + static_cast<std::uint32_t>(right * i / kSteps));
    }
    left_ += static_cast<std::uint32_t>(left);
    right_ += static_cast<std::uint32_t>(right);
    return sample;
  }

  console::Counters counters;
  config::Devices devices;
  Opening opening{devices, counters, {}};
  Encoders odometry{opening};

 private:
  base::Time now_;
  std::uint32_t left_ = 0;
  std::uint32_t right_ = 0;
};

TEST_F(EncodersTest, SaysAPoseEveryTwentyMilliseconds) {
  EXPECT_TRUE(board::counters.started);
  EXPECT_TRUE(odometry.poll(base::Time{}));
  EXPECT_EQ(odometry.poll(base::Time{} + base::milliseconds(19)).error(), base::Error::kNotReady);
  EXPECT_TRUE(odometry.poll(base::Time{} + base::milliseconds(20)));
}

TEST_F(EncodersTest, ARevolutionOfBothIsTheWheelsRim) {
  at(0, 0);
  const auto pose = roll(kCounts, kCounts);
  EXPECT_NEAR(pose.x.to_double(), kRevolution, 2e-4);
  EXPECT_NEAR(pose.y.to_double(), 0, 1e-4);
  EXPECT_NEAR(pose.heading.to_double(), 0, 1e-4);
}

// Half a revolution against each other: the rim goes a quarter of a circle of half the track, 65 mm.
TEST_F(EncodersTest, WheelsAgainstEachOtherTurnOnTheSpot) {
  at(0, 0);
  const auto pose = roll(-720, 720);
  EXPECT_NEAR(pose.heading.to_double(), std::numbers::pi / 2, 1e-3);
  EXPECT_NEAR(std::hypot(pose.x.to_double(), pose.y.to_double()), 0, 1e-3);
}

TEST_F(EncodersTest, GoesOnWhereTheCountersWrap) {
  at(0, 0);
  sensor::OdometrySample pose;
  for (int revolution = 0; revolution < 60; ++revolution) pose = roll(kCounts, kCounts);  // 86,400 counts
  EXPECT_NEAR(pose.x.to_double(), 60 * kRevolution, 1e-2);
  for (int revolution = 0; revolution < 60; ++revolution) {
    pose = roll(-static_cast<std::int32_t>(kCounts), -static_cast<std::int32_t>(kCounts));
  }
  EXPECT_NEAR(pose.x.to_double(), 0, 1e-2);
}

TEST_F(EncodersTest, IsEmptyUntilAWheelTurns) {
  EXPECT_EQ(odometry.link(), sensor::LinkState::kEmpty);
  at(0, 0);
  EXPECT_EQ(odometry.link(), sensor::LinkState::kEmpty);
  at(0, 1);
  EXPECT_EQ(odometry.link(), sensor::LinkState::kOk);
}

}  // namespace
}  // namespace fencepost::image
