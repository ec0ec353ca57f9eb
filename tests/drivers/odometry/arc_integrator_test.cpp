#include "drivers/odometry/arc_integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fencepost::odometry {
namespace {

constexpr std::int64_t kMetre = 1'000'000'000'000;  // pm
constexpr std::int64_t kQuarter = 1'570'796;        // urad

std::int64_t pm(double metres) { return std::llround(metres * static_cast<double>(kMetre)); }

TEST(ArcIntegrator, DrivesStraight) {
  ArcIntegrator pose;
  pose.advance(kMetre + kMetre / 4, 0);
  EXPECT_EQ(pose.sample({7}), (sensor::OdometrySample{{7}, {12'500}, {0}, {0}}));
  pose.advance(-kMetre, 0);
  EXPECT_EQ(pose.sample({8}), (sensor::OdometrySample{{8}, {2'500}, {0}, {0}}));
}

TEST(ArcIntegrator, TurnsOnTheSpot) {
  ArcIntegrator pose;
  pose.advance(0, kQuarter);
  EXPECT_EQ(pose.sample({}), (sensor::OdometrySample{{}, {0}, {0}, {15'708}}));
  pose.advance(kMetre, kQuarter);
  EXPECT_EQ(pose.sample({}), (sensor::OdometrySample{{}, {0}, {10'000}, {15'708}}));
}

// A quarter of a circle of 1 m radius to the left ends at (1, 1), looking along y; in one step of any size.
TEST(ArcIntegrator, OneStepOrAThousandAreTheSameArc) {
  for (const int steps : {1, 2, 3, 10, 1'000}) {
    ArcIntegrator pose;
    const double length = std::numbers::pi / 2;
    for (int i = 1; i <= steps; ++i) {
      pose.advance(pm(length * i / steps) - pm(length * (i - 1) / steps), std::llround(length * 1e6 * i / steps));
    }
    const sensor::OdometrySample end = pose.sample({});
    EXPECT_EQ(end.x.raw, 10'000) << steps;
    EXPECT_EQ(end.y.raw, 10'000) << steps;
    EXPECT_EQ(end.heading.raw, 15'708) << steps;
  }
}

// Closed form, in double: x = r sin a, y = r (1 - cos a), for arcs up to two turns in one step, forwards and back.
TEST(ArcIntegrator, AgreesWithTheClosedForm) {
  for (double radius = -3; radius <= 3; radius += 0.37) {
    for (double angle = -12.5; angle <= 12.5; angle += 0.173) {
      ArcIntegrator pose;
      const auto urad = std::llround(angle * 1e6);
      const double exact = static_cast<double>(urad) * 1e-6;
      pose.advance(pm(radius * exact), urad);
      const sensor::OdometrySample end = pose.sample({});
      EXPECT_NEAR(end.x.to_double(), radius * std::sin(exact), 6e-5) << radius << ' ' << angle;
      EXPECT_NEAR(end.y.to_double(), radius * (1 - std::cos(exact)), 6e-5) << radius << ' ' << angle;
      EXPECT_NEAR(end.heading.to_double(), std::remainder(exact, 2 * std::numbers::pi), 6e-5);
    }
  }
}

// 100 km in one step of two radians: sin 1 cos 1 and sin 1 sin 1 of it, to 2e-7. At one radian the series is used,
// beyond the sine itself.
TEST(ArcIntegrator, ChordsOfOneRadianToEitherSideOfTheSeriesEnd) {
  const struct {
    std::int64_t half;
    std::int32_t x, y;
  } cases[] = {{1'000'000, 454'648'702, 708'073'416},
               {1'000'001, 454'647'839, 708'073'666},
               {-1'000'000, 454'648'702, -708'073'416},
               {-1'000'001, 454'647'839, -708'073'666}};
  for (const auto& [half, x, y] : cases) {
    ArcIntegrator pose;
    pose.advance(100'000 * kMetre, 2 * half);
    EXPECT_EQ(pose.sample({}).x.raw, x) << half;
    EXPECT_EQ(pose.sample({}).y.raw, y) << half;
    EXPECT_NEAR(pose.sample({}).x.to_double(), 1e5 * std::sin(1.0) * std::cos(1e-6 * static_cast<double>(half)), 0.02);
  }
}

// 50251105 pm along 0.100012 rad are 49999999.47 along x: less than half of a tenth of a millimetre, by a picometre.
TEST(ArcIntegrator, RoundsToTheNearestPicometre) {
  for (const std::int64_t sign : {1, -1}) {
    ArcIntegrator pose;
    pose.advance(0, 100'012);
    pose.advance(sign * 50'251'105, 100'012);
    EXPECT_EQ(pose.sample({}).x.raw, 0);
    pose.advance(sign * 1, 100'012);
    EXPECT_EQ(pose.sample({}).x.raw, sign);
  }
}

// 50 Hz for eight hours on a circle of 0.5 m radius, a turn in 20 s: back where it was, 1440 times.
TEST(ArcIntegrator, DoesNotDriftOverADay) {
  ArcIntegrator pose;
  constexpr int kStepsATurn = 1'000;
  constexpr std::int64_t kTurns = 1'440;
  const double length = std::numbers::pi;  // of one turn, m
  for (std::int64_t i = 1; i <= kTurns * kStepsATurn; ++i) {
    const std::int64_t before = pm(length * static_cast<double>(i - 1) / kStepsATurn);
    const std::int64_t after = pm(length * static_cast<double>(i) / kStepsATurn);
    pose.advance(after - before, std::llround(2e6 * std::numbers::pi * static_cast<double>(i) / kStepsATurn));
  }
  const sensor::OdometrySample end = pose.sample({});
  EXPECT_NEAR(end.x.raw, 0, 10) << "0.1 mm each, of 4.5 km";
  EXPECT_NEAR(end.y.raw, 0, 10);
  EXPECT_NEAR(end.heading.raw, 0, 1);
}

TEST(ArcIntegrator, WrapsTheHeadingAnywhere) {
  for (const double turns : {0.49, 0.51, -0.51, 100.25, -1'000'000.25}) {
    ArcIntegrator pose;
    const double heading = turns * 2 * std::numbers::pi;
    pose.advance(0, std::llround(heading * 1e6));
    const double expected = std::remainder(turns, 1.0) * 2 * std::numbers::pi;
    EXPECT_NEAR(pose.sample({}).heading.to_double(), expected, 6e-5) << turns;
  }
}

TEST(ArcIntegrator, EndsAtTheEdgeOfTheWorldWithoutOverflow) {
  ArcIntegrator pose;
  for (int i = 0; i < 8; ++i) pose.advance(1'000'000 * kMetre, 0);
  EXPECT_EQ(pose.sample({}).x.raw, 2'000'000'000);
}

TEST(DivideNearest, RoundsHalfAwayFromZero) {
  EXPECT_EQ(divide_nearest(5, 10), 1);
  EXPECT_EQ(divide_nearest(4, 10), 0);
  EXPECT_EQ(divide_nearest(-5, 10), -1);
  EXPECT_EQ(divide_nearest(-4, 10), 0);
  EXPECT_EQ(divide_nearest(-26, 10), -3);
}

}  // namespace
}  // namespace fencepost::odometry
