#include "firmware/recon/localize/drift_evidence.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::CircleEquation;
using recon::DriftEvidence;
using recon::Vec2;

constexpr float kSigma = 0.02F;  // m
constexpr float kBearingVariance = kSigma * kSigma;

/// That the object is `aside` m left of straight ahead.
CircleEquation bearing(float aside) { return {{0, 1}, aside, 0, {0, 1}}; }
Vec2 at(float distance, float aside) { return {distance, aside}; }

// Two sigmas off by the odometry, none by the filter: 3.9 each, and 32 with the ninth.
TEST(DriftEvidence, BearingsThatOnlyTheFilterExplainsAreDrift) {
  DriftEvidence evidence;
  for (int n = 1; n <= 9; ++n) {
    EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence)) << n;
    evidence.weigh(bearing(0), kBearingVariance, at(2, 2 * kSigma), at(2, 0));
  }
  EXPECT_TRUE(evidence.enough(recon::kPaceOfDesks.evidence));
  evidence.clear();
  EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence));
}

// A row that lies moves the filter's landmark along its bearing, and the robot with it.
TEST(DriftEvidence, WhereTheRowsPutAnObjectIsNoDrift) {
  DriftEvidence evidence;
  for (int n = 0; n < 1000; ++n) evidence.weigh(bearing(0), kBearingVariance, at(2, 0), at(3, 0));
  EXPECT_EQ(evidence.sum(), 0);
}

TEST(DriftEvidence, OneOutlierIsNoDrift) {
  DriftEvidence evidence;
  evidence.weigh(bearing(0), kBearingVariance, at(2, 1), at(2, 0));
  EXPECT_LE(evidence.sum(), recon::kMostEvidence);
  EXPECT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence));
}

// The filter follows 2 % of a noise that is twice as large as was thought, for an hour.
TEST(DriftEvidence, FollowingNoiseIsNoDrift) {
  DriftEvidence evidence;
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 2 * kSigma);
  for (int n = 0; n < 36'000; ++n) {
    const float aside = noise(random);
    evidence.weigh(bearing(aside), kBearingVariance, at(2, 0), at(2, 0.01F * aside));
    ASSERT_FALSE(evidence.enough(recon::kPaceOfDesks.evidence)) << n;
  }
}

// Sums that are exact: it is enough when it is more than what is asked for, not when it is that.
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
      evidence.weigh(seen, draw.of({0.015625F, 0.0625F}), by_odometry, by_filter);
      sweep.tell("sum", evidence.sum());
      sweep.tell("enough", evidence.enough(evidence.sum()));
      sweep.tell("more than enough", evidence.enough(draw.of({0.0F, 1.0F, 6.0F})));
    }
    evidence.clear();
    sweep.tell("cleared", evidence.sum());
  }
  expect_said(sweep,
              {"sum 2770 0724262f", "enough 0 a6894d9b", "more than enough 2045 16295751", "cleared 0 f3600d4f"});
}

}  // namespace
}  // namespace fencepost::test
