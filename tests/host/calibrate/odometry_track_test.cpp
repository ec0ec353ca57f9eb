#include "host/calibrate/odometry_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/simulate/random.hpp"

namespace fencepost::host {
namespace {

TEST(OdometryTrack, IsInterpolatedAndHeldBeyondItsEnds) {
  const OdometryTrack track({{0, 0, 0, 0}, {1, 0.2, 0, 0}, {2, 0.2, 0, 0.5}});
  EXPECT_DOUBLE_EQ(track.at(0.5).x, 0.1);
  EXPECT_DOUBLE_EQ(track.at(1.5).heading, 0.25);
  EXPECT_DOUBLE_EQ(track.at(9).x, 0.2);
  EXPECT_DOUBLE_EQ(track.at(-9).x, 0);
  EXPECT_DOUBLE_EQ(track.at(0.5).way, 0.1);
}

TEST(OdometryTrack, BackwardsCountsAgainstTheWay) {
  const OdometryTrack track({{0, 0, 0, 0}, {1, 0.5, 0, 0}, {2, 0.2, 0, 0}});
  EXPECT_NEAR(track.at(2).way, 0.2, 1e-12);
  EXPECT_NEAR(track.driven(), 0.8, 1e-12);
}

TEST(OdometryTrack, AWrappedHeadingGoesOn) {
  const double half = std::numbers::pi;
  const OdometryTrack track({{0, 0, 0, half - 0.1}, {1, 0, 0, -half + 0.1}});
  EXPECT_NEAR(track.at(1).heading - track.at(0).heading, 0.2, 1e-12);
  EXPECT_NEAR(track.turned(), 0.2, 1e-12);
}

TEST(OdometryTrack, SmoothWheelsStayAsTheyAre) {
  std::vector<TimedPose> samples;
  for (int i = 0; i < 200; ++i) samples.push_back({0.02 * i, 0.004 * i, 0, 0.01 * i});
  const OdometryTrack track(samples);
  EXPECT_LT(track.white().position, 1e-9);
  EXPECT_DOUBLE_EQ(track.at(2.0).x, samples[100].x);
}

TEST(OdometryTrack, TheNoiseOfSamplesIsMeasuredAndMostOfItGoes) {
  constexpr double kPosition = 0.002;
  constexpr double kHeading = 0.0035;
  std::vector<TimedPose> samples;
  Random random(3, Purpose::kViewPose, 0);
  for (int i = 0; i < 600; ++i) {
    samples.push_back({0.02 * i, 0.004 * i + kPosition * random.gaussian(), kPosition * random.gaussian(),
                       0.01 * i + kHeading * random.gaussian()});
  }
  const OdometryTrack track(samples);
  double square = 0;
  for (int i = 0; i < 600; ++i) square += std::pow(track.at(0.02 * i).heading - 0.01 * i, 2);
  const double left = std::sqrt(square / 600);
  EXPECT_LT(left, 0.6 * kHeading);
  EXPECT_NEAR(track.white().heading, left, 0.3 * left);
  EXPECT_NEAR(track.white().position, 0.45 * kPosition, 0.15 * kPosition);
}

TEST(MedianOf, IsTheMiddleOneAndZeroOfNone) {
  EXPECT_EQ(median_of({}), 0);
  EXPECT_EQ(median_of({5, 1, 3}), 3);
}

}  // namespace
}  // namespace fencepost::host
