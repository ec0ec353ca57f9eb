#include "firmware/recon/localize/pose_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace fencepost::test {
namespace {

using recon::LandmarkFilter;
using recon::MeasurementNoise;
using recon::SightedCircle;
using recon::Sighting;
using recon::Vec2;

constexpr std::size_t kWidth = 0, kMiddle = 1, kFoot = 2;
constexpr float kFocal = 200;  // px

Vec2 unit(double angle) { return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}; }

/// A circle at (x, y) of radius r in the robot frame as a lens at the robot's origin sees it, turned by `off` rad.
Sighting sighting_of(double x, double y, double r, double off = 0) {
  const double bearing = std::atan2(y, x) + off;
  const double half = std::asin(r / std::hypot(x, y));
  Sighting seen;
  seen.focal = kFocal;
  seen.center = unit(bearing);
  seen.left = {unit(bearing + half), recon::End::kSeen};
  seen.right = {unit(bearing - half), recon::End::kSeen};
  seen.bottom.end = recon::End::kLowerBound;
  return seen;
}

float residual(const recon::CircleEquation& equation, const Vec2& center, float radius) {
  return equation.bound - equation.normal.dot(center) - equation.radii * radius;
}

// 2 m ahead and 1.5 m to the left: 2.5 m away; the bearing's direction is (0.8, 0.6), left of it (-0.6, 0.8).
constexpr double kX = 2, kY = 1.5;
constexpr float kRadius = 0.5F;  // m
const Vec2 kCenter{2, 1.5F};

TEST(SightedCircle, BothEndsSayWidthAndMiddle) {
  const SightedCircle circle = sighted_circle(sighting_of(kX, kY, 0.5), kCenter, kRadius, 1, {});
  const auto& width = circle.lines[kWidth].equation;
  const auto& middle = circle.lines[kMiddle].equation;
  // sine 0.2, cosine sqrt(0.96): half the sum points at the lens, half the difference to the left.
  EXPECT_NEAR(width.normal.x(), -0.2 * 0.8, 1e-6);
  EXPECT_NEAR(width.normal.y(), -0.2 * 0.6, 1e-6);
  EXPECT_EQ(width.radii, 1);
  EXPECT_NEAR(middle.normal.x(), -0.6 * std::sqrt(0.96), 1e-6);
  EXPECT_NEAR(middle.normal.y(), 0.8 * std::sqrt(0.96), 1e-6);
  EXPECT_EQ(middle.radii, 0);
  for (const auto& equation : {width, middle}) {
    EXPECT_NEAR(residual(equation, kCenter, kRadius), 0, 1e-6);
    EXPECT_LT((equation.slope - equation.normal).norm(), 1e-6F);
  }
  EXPECT_EQ(circle.lines[kFoot].variance, 0);
}

TEST(SightedCircle, AWrongHeadingMovesTheMiddleAndNotTheWidth) {
  constexpr double kOff = 0.01;
  const SightedCircle circle = sighted_circle(sighting_of(kX, kY, 0.5, kOff), kCenter, kRadius, 1, {});
  // cos(asin 0.2) * 2.5 m * 10 mrad, and of the second order 0.2 * 2.5 m * (10 mrad)^2 / 2.
  EXPECT_NEAR(residual(circle.lines[kMiddle].equation, kCenter, kRadius), std::sqrt(0.96) * 0.025, 1e-4);
  EXPECT_LT(std::fabs(residual(circle.lines[kWidth].equation, kCenter, kRadius)), 5e-5F);
}

TEST(SightedCircle, OneEndIsATangent) {
  for (const bool left : {true, false}) {
    Sighting seen = sighting_of(kX, kY, 0.5);
    (left ? seen.right : seen.left).end = recon::End::kLowerBound;
    const SightedCircle circle = sighted_circle(seen, kCenter, kRadius, 1, {});
    const auto& tangent = circle.lines[0].equation;
    EXPECT_NEAR(tangent.normal.norm(), 1, 1e-6);
    EXPECT_NEAR(residual(tangent, kCenter, kRadius), 0, 1e-6);
    EXPECT_LT((tangent.slope - tangent.normal).norm(), 1e-6F);
    EXPECT_EQ(circle.lines[1].variance, 0);
  }
}

TEST(SightedCircle, ABearingIsItsMiddleAlone) {
  Sighting seen = sighting_of(kX, kY, 0.5);
  seen.bearing = true;
  seen.left.end = seen.right.end = recon::End::kOccluded;
  const SightedCircle circle = sighted_circle(seen, kCenter, kRadius, 1, {});
  EXPECT_EQ(circle.lines[kWidth].variance, 0);
  EXPECT_EQ(circle.lines[kFoot].variance, 0);
  EXPECT_GT(circle.middle().variance, 0);
  EXPECT_EQ(circle.middle().equation.radii, 0);
  EXPECT_NEAR(residual(circle.middle().equation, kCenter, kRadius), 0, 1e-2);
}

// Straight ahead, so that a pixel is 1 / f rad; 3 m away.
TEST(SightedCircle, VariancesAreThoseOfTheEndsAndThePose) {
  MeasurementNoise noise;
  noise.edge_px = 2;
  noise.heading = 0.008F;
  noise.position = 0.005F;
  noise.roundness = 0.1F;
  constexpr double kEnd = 3 * 2 / 200.0, kTurned = 3 * 0.008, kPlace = 0.005, kShape = 0.1 * 0.06;
  const Sighting seen = sighting_of(3, 0, 0.06);
  const SightedCircle both = sighted_circle(seen, {3, 0}, 0.06F, 1, noise);
  const double each = 0.5 * (kEnd * kEnd + kShape * kShape);
  EXPECT_NEAR(both.lines[kWidth].variance, each, 1e-3 * each);
  EXPECT_NEAR(both.lines[kMiddle].variance, each + kTurned * kTurned + kPlace * kPlace, 1e-3 * each);
  Sighting half = seen;
  half.right.end = recon::End::kLowerBound;
  const double alone = kEnd * kEnd + kShape * kShape + kTurned * kTurned + kPlace * kPlace;
  EXPECT_NEAR(sighted_circle(half, {3, 0}, 0.06F, 1, noise).lines[0].variance, alone, 1e-3 * alone);
  EXPECT_NEAR(sighted_circle(half, {3, 0}, 0.06F, 0.25F, noise).lines[0].variance, 4 * alone, 4e-3 * alone);
}

/// The foot's row of a circle on the floor, seen by a level equidistant lens 0.12 m above the robot's origin. It is the
/// lowest image of the rim, read in the middle between its ends.
Sighting foot_through_a_fisheye(double x, double y, double r) {
  constexpr double kHeight = 0.12;
  Sighting seen = sighting_of(x, y, r);
  double lowest = 0;  // of the rim, rad from the middle of the image downwards
  for (int i = 0; i < 3600; ++i) {
    const double forward = x + r * std::cos(i * 1.7453e-3), left = y + r * std::sin(i * 1.7453e-3);
    const double off = std::hypot(left, kHeight);
    lowest = std::max(lowest, std::atan2(off, forward) * kHeight / off);
  }
  const double across = std::atan2(y, x);
  const double radius = std::hypot(across, lowest);
  seen.bottom = {static_cast<float>(lowest * std::tan(radius) / radius), recon::End::kSeen};
  seen.lens_height = static_cast<float>(kHeight);
  seen.rows_known = seen.equidistant = true;
  return seen;
}

// The foot is right to a centimetre as a range along its ray. Taken for a depth along the axis, it would be off by 3
// cm.
TEST(SightedCircle, AFootThroughAFisheyeIsARange) {
  constexpr float kSmall = 0.06F;
  for (const double bearing : {0.0, 0.7, -1.0}) {
    const double x = 1.2 * std::cos(bearing), y = 1.2 * std::sin(bearing);
    const Vec2 center{static_cast<float>(x), static_cast<float>(y)};
    Sighting seen = foot_through_a_fisheye(x, y, kSmall);
    const auto foot = sighted_circle(seen, center, kSmall, 1, {}).lines[kFoot];
    EXPECT_GT(foot.variance, 0) << bearing;
    EXPECT_NEAR(residual(foot.equation, center, kSmall), 0, 0.01) << bearing;
  }
  Sighting taken_for_a_pinhole = foot_through_a_fisheye(1.2 * std::cos(1.0), 1.2 * std::sin(1.0), kSmall);
  taken_for_a_pinhole.equidistant = false;
  const Vec2 center = 1.2F * unit(1.0);
  const auto foot = sighted_circle(taken_for_a_pinhole, center, kSmall, 1, {}).lines[kFoot];
  EXPECT_GT(std::fabs(residual(foot.equation, center, kSmall)), 0.02);
}

TEST(SightedCircle, NothingIsSaidOfWhatIsAtTheLens) {
  const SightedCircle circle = sighted_circle(sighting_of(kX, kY, 0.5), {0, 0}, kRadius, 1, {});
  for (const auto& line : circle.lines) EXPECT_EQ(line.variance, 0);
}

/// How far away a landmark 4 m ahead seems to be after `views` from a robot that sways sideways, by the filter.
float found_distance(unsigned seed, int views) {
  constexpr double kDistance = 4, kRadiusThere = 0.06, kSway = 0.12;
  constexpr float kBearing = 0.01F;  // rad, sigma
  std::mt19937 random(seed);
  std::normal_distribution<double> wrong(0, static_cast<double>(kBearing));
  const auto filter = std::make_unique<LandmarkFilter<1>>();
  recon::start(filter->view());
  recon::LandmarkGuess guess;
  guess.away = {3, 0};
  guess.radius = 0.08F;
  guess.covariance = {2.25F, 0, 0.01F, 0, 0, 0.0025F};
  recon::add_landmark(filter->view(), 0, guess);
  MeasurementNoise noise;
  noise.heading = kBearing;
  std::array<float, LandmarkFilter<1>::kStates> scratch{};
  for (int i = 0; i < views; ++i) {
    const double y = kSway * std::sin(0.1 * i);
    recon::MapPose pose;
    pose.position = recon::moved({}, {0, static_cast<float>(y)});
    recon::drive_to(filter->view(), pose, {}, scratch);
    filter->view().at.pose = pose;
    const Vec2 away = recon::offset_from(pose.position, filter->landmark(0).center);
    const Sighting seen = sighting_of(kDistance, -y, kRadiusThere, wrong(random));
    const SightedCircle circle = sighted_circle(seen, away, filter->landmark(0).radius, 1, noise);
    for (const auto& line : circle.lines) {
      if (line.variance > 0) recon::correct_by(filter->view(), 0, line.equation, line.variance, scratch);
    }
  }
  return recon::offset_from({}, filter->landmark(0).center).x();
}

// Noisy directions have parallax to themselves. As derivatives they draw the landmark to the lens, ever nearer the more
// of them there are; the directions that are expected do not.
TEST(SightedCircle, NoiseDrawsNothingToTheLens) {
  float mean = 0;
  constexpr unsigned kRuns = 20;
  for (unsigned seed = 1; seed <= kRuns; ++seed) mean += found_distance(seed, 600) / kRuns;
  EXPECT_NEAR(mean, 4, 0.2);
}

// A configured width tells the range: as far as the width may be wrong (5 %) and both ends may be, drawn and counted.
TEST(LandmarkGuess, AConfiguredWidthTellsTheRange) {
  MeasurementNoise noise;
  noise.edge_px = 1;
  noise.roundness = 0;
  recon::ObjectCore unplaced;
  const auto guess = [&](double radius, double off_left, double off_right) {
    Sighting seen = sighting_of(kX, kY, radius);
    const double bearing = std::atan2(kY, kX), half = std::asin(radius / 2.5);
    seen.left.direction = unit(bearing + half + off_left);
    seen.right.direction = unit(bearing - half + off_right);
    seen.center = unit(bearing + 0.5 * (off_left + off_right));
    seen.axis = unit(bearing);
    seen.known_radius = 0.1F;
    return guess_of(unplaced, seen, noise);
  };
  const recon::LandmarkGuess exact = guess(0.1, 0, 0);
  EXPECT_NEAR(exact.away.x(), kX, 0.002);
  EXPECT_NEAR(exact.away.y(), kY, 0.002);
  EXPECT_FLOAT_EQ(exact.radius, 0.1F);

  const Vec2 along{0.8F, 0.6F};
  const double known = 0.1 * static_cast<double>(recon::kKnownRadiusSigma);
  std::mt19937 random(7);
  std::normal_distribution<double> gauss;
  constexpr int kDraws = 4000;
  double range2 = 0, with_radius = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double off_radius = known * gauss(random);
    const auto end = [&] { return gauss(random) / static_cast<double>(kFocal); };
    const Vec2 away = guess(0.1 + off_radius, end(), end()).away;
    const auto off = static_cast<double>((away - kCenter).dot(along));
    range2 += off * off / kDraws;
    with_radius -= off * off_radius / kDraws;  // taken for the configured one
  }
  const recon::Symmetric3& covariance = exact.covariance;
  EXPECT_NEAR(covariance.position_along(along), range2, 0.15 * range2);
  EXPECT_NEAR(along.dot({covariance.xr, covariance.yr}), with_radius, 0.15 * with_radius);
  EXPECT_NEAR(std::sqrt(covariance.rr), known, 1e-6);
}

}  // namespace
}  // namespace fencepost::test
