// Drift and per-view pose noise, as the odometry stream shows them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

Scene straight_metre() {
  Scene scene = empty_scene();
  scene.rate = 10;
  scene.path = WaypointPath{{{0, 0}, {1, 0}}, 0.5, 1};
  return scene;
}

TEST(Drift, NoneReportsTheTruth) {
  const Simulated simulated = run(straight_metre());
  EXPECT_EQ(simulated.log.odometry.back().x.raw, 10'000);
  EXPECT_EQ(simulated.log.odometry[50].x.raw, 5'000);
}

TEST(Drift, ScaleIsAShareOfTheDistance) {
  Scene scene = straight_metre();
  scene.noise.drift_scale = 0.03;
  EXPECT_NEAR(run(scene).log.odometry.back().x.to_double(), 1.03, 1e-4);
  scene.noise.drift_scale = -0.03;
  EXPECT_NEAR(run(scene).log.odometry.back().x.to_double(), 0.97, 1e-4);
}

TEST(Drift, TurnIsRadiansPerMetreAndBendsThePath) {
  Scene scene = straight_metre();
  scene.noise.drift_turn = 0.2;
  const auto end = run(scene).log.odometry.back();
  EXPECT_NEAR(end.heading.to_double(), 0.2, 1e-4);
  // A straight metre becomes an arc of radius 1 / 0.2 = 5 m: (5 sin 0.2, 5 (1 - cos 0.2)).
  EXPECT_NEAR(end.x.to_double(), 5 * std::sin(0.2), 2e-4);
  EXPECT_NEAR(end.y.to_double(), 5 * (1 - std::cos(0.2)), 2e-4);
}

TEST(Drift, WalkGrowsWithTheRootOfTheDistance) {
  double squares = 0;
  constexpr int kRuns = 200;
  for (int i = 0; i < kRuns; ++i) {
    Scene scene = straight_metre();
    scene.rate = 1;
    scene.seed = static_cast<std::uint64_t>(i);
    scene.noise.drift_walk = 0.05;
    const auto end = run(scene).log.odometry.back();
    squares += std::pow(end.x.to_double() - 1, 2) + std::pow(end.y.to_double(), 2);
  }
  // 0.05 m on each axis after 1 m; the estimate's own sigma is 0.05 / sqrt(4 * 200) = 0.0018.
  EXPECT_NEAR(std::sqrt(squares / (2 * kRuns)), 0.05, 0.009);
}

TEST(Drift, StandingStillDoesNotDrift) {
  Scene scene = empty_scene();
  scene.path = standing(1, 2, 0.5, 100);
  scene.noise.drift_walk = 1;
  scene.noise.drift_scale = 0.5;
  scene.noise.drift_turn = 1;
  const auto end = run(scene).log.odometry.back();
  EXPECT_EQ(end.x.raw, 10'000);
  EXPECT_EQ(end.heading.raw, 5'000);
}

/// The reader's interpolation.
TimedPose reported_at(const Simulated& simulated, base::Time t) {
  const auto& samples = simulated.log.odometry;
  std::size_t i = 0;
  while (i + 2 < samples.size() && samples[i + 1].t < t) ++i;
  const double share =
      static_cast<double>((t - samples[i].t).raw) / static_cast<double>((samples[i + 1].t - samples[i].t).raw);
  const auto mix = [&](auto a, auto b) { return a.to_double() + share * (b.to_double() - a.to_double()); };
  return {t.to_double(), mix(samples[i].x, samples[i + 1].x), mix(samples[i].y, samples[i + 1].y),
          mix(samples[i].heading, samples[i + 1].heading)};
}

TEST(ViewNoise, IsExactAtTheExposureAndIndependentPerView) {
  for (const double rate : {12.5, 20.0, 24.0, 50.0}) {
    Scene scene = empty_scene();
    scene.rate = rate;
    scene.path = standing(1, 2, 0.5, 1000, rate);
    scene.noise.pose_xy = 0.01;
    scene.noise.pose_heading = 0.02;
    const Simulated simulated = run(scene);
    double xx = 0;
    double hh = 0;
    double neighbours = 0;
    double previous = 0;
    for (const FrameTruth& truth : simulated.truth) {
      const TimedPose pose = reported_at(simulated, truth.exposure);
      const double dx = pose.x - truth.pose.x;
      const double dh = pose.heading - truth.pose.heading;
      xx += dx * dx;
      hh += dh * dh;
      neighbours += dx * previous;
      previous = dx;
    }
    // Blending two views would show as sigma / sqrt(2) and as correlation.
    EXPECT_NEAR(std::sqrt(xx / 1000), 0.01, 0.0012) << rate;
    EXPECT_NEAR(std::sqrt(hh / 1000), 0.02, 0.0024) << rate;
    EXPECT_NEAR(neighbours / xx, 0, 0.17) << rate;
  }
}

}  // namespace
}  // namespace fencepost::host
