#include "firmware/recon/localize/drift_evidence.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::CircleEquation;
using DriftEvidence = recon::DriftEvidence<4>;
using recon::Vec2;

constexpr float kSigma = 0.02F;  // m
constexpr float kBearingVariance = kSigma * kSigma;

/// The equation by which the object is `aside` m left of straight ahead.
CircleEquation bearing(float aside) { return {{0, 1}, aside, 0, {0, 1}}; }
Vec2 at(float distance, float aside) { return {distance, aside}; }

// Two sigmas off by the odometry, none by the filter: 3.9 each, and 32 with the ninth of either landmark.
TEST(DriftEvidence, BearingsThatOnlyTheFilterExplainsAreDrift) {
  DriftEvidence evidence;
  for (int n = 1; n <= 18; ++n) {
    EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence)) << n;
    evidence.weigh(n % 2 == 0 ? 3 : 1, bearing(0), kBearingVariance, at(2, 2 * kSigma), at(2, 0));
  }
  EXPECT_TRUE(evidence.enough(recon::kPaceOfDesks.evidence));
  evidence.forget(1);
  EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence)) << "only one is left";
  evidence.clear();
  EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence));
}

// The other three are where odometry has them: that one was mixed up.
TEST(DriftEvidence, WhatOneLandmarkAloneSaysIsNoDrift) {
  DriftEvidence evidence;
  for (int n = 0; n < 1000; ++n) {
    evidence.weigh(2, bearing(0), kBearingVariance, at(2, 3 * kSigma), at(2, 0));
    evidence.weigh(n % 2 == 0 ? 0 : 3, bearing(0), kBearingVariance, at(2, 0), at(2, 0));
    ASSERT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence)) << n;
  }
  EXPECT_GT(evidence.sum(), recon::kPaceOfDesks.evidence);
}

// A row that lies moves the filter's landmark along its bearing, and the robot with it.
TEST(DriftEvidence, WhereTheRowsPutAnObjectIsNoDrift) {
  DriftEvidence evidence;
  for (int n = 0; n < 1000; ++n) evidence.weigh(0, bearing(0), kBearingVariance, at(2, 0), at(3, 0));
  EXPECT_EQ(evidence.sum(), 0);
}

TEST(DriftEvidence, OneOutlierIsNoDrift) {
  DriftEvidence evidence;
  evidence.weigh(0, bearing(0), kBearingVariance, at(2, 1), at(2, 0));
  EXPECT_LE(evidence.sum(), recon::kMaxEvidence);
  EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence));
}

// The filter follows 2 % of a noise that is twice as large as was thought, for an hour.
TEST(DriftEvidence, FollowingNoiseIsNoDrift) {
  DriftEvidence evidence;
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 2 * kSigma);
  for (int n = 0; n < 36'000; ++n) {
    const float aside = noise(random);
    evidence.weigh(static_cast<std::size_t>(n % 4), bearing(aside), kBearingVariance, at(2, 0), at(2, 0.01F * aside));
    ASSERT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence)) << n;
  }
}

// Sums that are exact: the evidence is enough when it is above the threshold, not when it equals it.
TEST(DriftEvidence, OfBearingsOnALattice) {
  Draw draw(201);
  Sweep sweep;
  for (int run = 0; run < 200; ++run) {
    DriftEvidence evidence;
    for (int i = 0; i < 20; ++i) {
      const CircleEquation seen{draw.of<Vec2>({{0, 1}, {1, 0}, {0.6F, 0.8F}}), draw.steps(-4, 4, 0.125F), 0, {0, 1}};
      const auto place = [&] { return Vec2{draw.steps(-4, 4, 0.125F), draw.steps(-4, 4, 0.125F)}; };
      const Vec2 by_odometry = place();
      const Vec2 by_filter = place();
      evidence.weigh(draw.of<std::size_t>({0, 1, 2, 3}), seen, draw.of({0.015625F, 0.0625F}), by_odometry, by_filter);
      sweep.tell("sum", evidence.sum());
      sweep.tell("enough", evidence.enough(evidence.sum()));
      sweep.tell("more than enough", evidence.enough(draw.of({0.0F, 1.0F, 6.0F})));
    }
    evidence.clear();
    sweep.tell("cleared", evidence.sum());
  }
  expect_said(sweep,
              {"sum 2850 731d4e28", "enough 0 a6894d9b", "more than enough 1465 e39f4945", "cleared 0 f3600d4f"});
}

}  // namespace
}  // namespace fencepost::test
