// Whole logs whose truth is known: the optimum is better where odometry strays and costs nothing where it does not.
#include "host/smooth/smooth.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "host/smooth/smooth_text.hpp"
#include "host/smooth/truth_par.hpp"
#include "tests/host/smooth/round_trip.hpp"

namespace fencepost::host {
namespace {

using test::round_trip;
using test::RoundTrip;
using test::RoundTripOptions;

Smoothed smoothed(const RoundTrip& trip, const SmoothOptions& options = {}) {
  const SmoothOutcome outcome = smooth(trip.log, "trip", options);
  if (!outcome.smoothed) throw std::runtime_error(outcome.refusal);
  return *outcome.smoothed;
}

double path_rms(const ResultDocument& map, const RoundTrip& trip) {
  std::vector<PointPair> pairs;
  std::size_t at = 0;
  for (const PoseResult& pose : map.path) {
    while (at + 1 < trip.way.size() && trip.way[at + 1].t <= pose.t + 1e-6) ++at;
    pairs.push_back({{pose.x, pose.y}, {trip.way[at].x, trip.way[at].y}});
  }
  return rms_of(distances_after(aligned(pairs), pairs));
}

class SmoothDrift : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SmoothDrift, OfThreePercentIsTakenBack) {
  RoundTripOptions options;
  options.seed = GetParam();
  options.drift = 0.03;
  const RoundTrip trip = round_trip(options);
  const Smoothed result = smoothed(trip);
  const SmoothEvaluation par = evaluate_smoothed(result, trip.scene, "trip");
  EXPECT_EQ(par.optimum.pairs, 6U);
  EXPECT_EQ(par.optimum.objects, 6U);
  EXPECT_LT(par.optimum.aligned, 0.5 * par.online.aligned);
  EXPECT_LT(par.optimum.aligned, 0.06);  // 3 % of 1.5 m is the odometry's metre, and no log tells that
  EXPECT_LT(path_rms(result.optimum, trip), 0.5 * path_rms(result.online, trip));
  EXPECT_LT(result.edges_after, 0.5 * result.edges_before);
  for (const SmoothedObject& object : result.objects) {
    ASSERT_TRUE(object.sigma);
    EXPECT_LT(*object.sigma, 0.2);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, SmoothDrift, ::testing::Values(301, 302));

TEST_P(SmoothDrift, IsTakenBackThroughAFisheye) {
  RoundTripOptions options;
  options.seed = GetParam();
  options.drift = 0.03;
  options.fisheye = 150;
  const RoundTrip trip = round_trip(options);
  const Smoothed result = smoothed(trip);
  const SmoothEvaluation par = evaluate_smoothed(result, trip.scene, "trip");
  EXPECT_EQ(par.optimum.pairs, 6U);
  EXPECT_LT(par.optimum.aligned, 0.06);
  EXPECT_LT(path_rms(result.optimum, trip), 0.02);
  EXPECT_LT(result.edges_after, 1.2);  // px; the noise is 0.7
}

struct Smooth : testing::Test {
  RoundTripOptions options;
};

TEST_F(Smooth, PerfectOdometryCostsNothing) {
  options.seed = 311;
  const RoundTrip trip = round_trip(options);
  const Smoothed result = smoothed(trip);
  const SmoothEvaluation par = evaluate_smoothed(result, trip.scene, "trip");
  EXPECT_EQ(par.optimum.objects, 6U);
  std::printf("  online %.4f, aligned %.4f; optimum %.4f, aligned %.4f m\n", par.online.as_it_stands,
              par.online.aligned, par.optimum.as_it_stands, par.optimum.aligned);
  // Blocks are seen from one side only: how far their middles are is a matter of millimetres for both.
  EXPECT_LT(par.optimum.as_it_stands, par.online.as_it_stands + 0.004);
  EXPECT_LT(path_rms(result.optimum, trip), 0.004);
  EXPECT_LT(result.drift, 2);
}

// Six blocks of one colour: what is joined is one, what stands apart stays apart.
TEST_F(Smooth, OneColourStaysSixBlocks) {
  options.seed = 321;
  options.one_colour = true;
  const RoundTrip trip = round_trip(options);
  const Smoothed result = smoothed(trip);
  EXPECT_EQ(result.objects.size(), 6U);
  EXPECT_LT(evaluate_smoothed(result, trip.scene, "trip").optimum.as_it_stands, 0.02);
}

TEST_F(Smooth, OneObjectIsEnough) {
  options.seed = 331;
  options.blocks = 1;
  const Smoothed result = smoothed(round_trip(options));
  EXPECT_EQ(result.objects.size(), 1U);
  EXPECT_EQ(result.optimum.path.size(), result.online.path.size());
}

TEST_F(Smooth, SkipsBadLinesAsAReplayDoes) {
  options.seed = 341;
  RoundTrip trip = round_trip(options);
  const std::size_t clean = smoothed(trip).objects.size();
  trip.log.insert(trip.log.find("$FPFRM"), "$FPFRM,garbage*0000\r\nnoise\r\n");
  const Smoothed result = smoothed(trip);
  EXPECT_EQ(result.objects.size(), clean);
  EXPECT_EQ(result.online.log.foreign, 1U);
}

TEST_F(Smooth, CalibratesOnRequestOnly) {
  options.seed = 351;
  const RoundTrip trip = round_trip(options);
  EXPECT_TRUE(smoothed(trip).findings.empty());
  SmoothOptions with;
  with.calibrate = true;
  const Smoothed result = smoothed(trip, with);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_NE(smooth_text(result, "trip").find("focal length"), std::string::npos);
  EXPECT_NEAR(result.camera.fx.to_double(), 273.6, 6);
}

TEST_F(Smooth, SaysWhatALogLacks) {
  options.blocks = 0;
  const SmoothOutcome outcome = smooth(round_trip(options).log, "empty floor", {});
  EXPECT_FALSE(outcome.smoothed);
  EXPECT_NE(outcome.refusal.find("empty floor: no object was seen"), std::string::npos) << outcome.refusal;
}

TEST_F(Smooth, SameBytesSameResult) {
  options.seed = 361;
  options.drift = 0.01;
  const RoundTrip trip = round_trip(options);
  EXPECT_EQ(smooth_json(smoothed(trip)), smooth_json(smoothed(trip)));
}

}  // namespace
}  // namespace fencepost::host
