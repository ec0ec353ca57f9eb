#include "hal/base/trig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/probe/trig_digest.hpp"

namespace fencepost::base {
namespace {

// The bounds that trig.hpp promises; the references are the C library's functions in double.
constexpr double kSinCosBound = 9e-8;  // of each component
constexpr double kAtan2Bound = 4e-7;   // rad

double sincos_error(std::int64_t microradians) {
  const SinCos got = sincos_urad(microradians);
  const long double angle = static_cast<long double>(microradians) * 1e-6L;
  const auto dc = static_cast<double>(static_cast<long double>(got.cos) - std::cos(angle));
  const auto ds = static_cast<double>(static_cast<long double>(got.sin) - std::sin(angle));
  return std::max(std::fabs(dc), std::fabs(ds));
}

double atan2_error(float y, float x) {
  return std::fabs(static_cast<double>(atan2_rad(y, x)) - std::atan2(static_cast<double>(y), static_cast<double>(x)));
}

TEST(SinCos, HoldsItsBoundNearZero) {
  double worst = 0;
  for (std::int64_t angle = -6'400'000; angle <= 6'400'000; angle += 7) worst = std::max(worst, sincos_error(angle));
  EXPECT_LE(worst, kSinCosBound);
}

TEST(SinCos, HoldsItsBoundAtTheEndsOfTheHeadingRange) {
  double worst = 0;
  for (std::int64_t angle = -1'000'000'000; angle <= 1'000'000'000; angle += 997) {
    worst = std::max(worst, sincos_error(angle));
  }
  EXPECT_LE(worst, kSinCosBound);
}

TEST(SinCos, HoldsItsBoundFarBeyondTheHeadingRange) {
  double worst = 0;
  for (std::int64_t offset = 0; offset <= 6'400'000; offset += 53) {
    worst = std::max({worst, sincos_error(10'000'000'000 - offset), sincos_error(offset - 10'000'000'000)});
  }
  EXPECT_LE(worst, kSinCosBound);
}

// An octant boundary is where the argument reduction changes its mind.
TEST(SinCos, HoldsItsBoundAroundEveryOctantBoundary) {
  double worst = 0;
  for (int octant = -1273; octant <= 1273; ++octant) {
    const auto boundary = static_cast<std::int64_t>(std::llround(octant * std::numbers::pi / 4 * 1e6));
    for (std::int64_t angle = boundary - 40; angle <= boundary + 40; ++angle) {
      worst = std::max(worst, sincos_error(angle));
    }
  }
  EXPECT_LE(worst, kSinCosBound);
}

TEST(SinCos, IsExactAtZero) {
  EXPECT_EQ(sincos_urad(0).cos, 1.0F);
  EXPECT_EQ(sincos_urad(0).sin, 0.0F);
}

TEST(SinCos, GivesUnitVectors) {
  for (const std::int64_t angle :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{-9'000'000'000'001}, std::int64_t{1},
        std::int64_t{9'000'000'000'000}, std::numeric_limits<std::int64_t>::max()}) {
    const SinCos got = sincos_urad(angle);
    EXPECT_NEAR(got.cos * got.cos + got.sin * got.sin, 1.0F, 3e-7F) << angle;
  }
}

TEST(Atan2, HoldsItsBoundAllAround) {
  double worst = 0;
  for (int i = 0; i < 4'000'000; ++i) {
    const double angle = -std::numbers::pi + i * (2 * std::numbers::pi / 4'000'000);
    const double radius = std::exp2(i % 41 - 20);
    worst = std::max(
        worst, atan2_error(static_cast<float>(radius * std::sin(angle)), static_cast<float>(radius * std::cos(angle))));
  }
  EXPECT_LE(worst, kAtan2Bound);
}

TEST(Atan2, HoldsItsBoundOnAGrid) {
  double worst = 0;
  for (int y = -1000; y <= 1000; ++y) {
    for (int x = -1000; x <= 1000; ++x) {
      worst = std::max(worst, atan2_error(static_cast<float>(y) * 0.001F, static_cast<float>(x) * 0.001F));
    }
  }
  EXPECT_LE(worst, kAtan2Bound);
}

TEST(Atan2, PutsTheAxesWhereTheyBelong) {
  EXPECT_EQ(atan2_rad(0, 0), 0.0F);
  EXPECT_EQ(atan2_rad(0, 1), 0.0F);
  EXPECT_EQ(atan2_rad(1, 0), 0.5F * kPi);
  EXPECT_EQ(atan2_rad(-1, 0), -0.5F * kPi);
  EXPECT_EQ(atan2_rad(0, -1), kPi);
  EXPECT_EQ(atan2_rad(-0.0F, -1), kPi);
}

TEST(Atan2, KnowsTheFourQuadrants) {
  EXPECT_NEAR(atan2_rad(1, 1), 0.25F * kPi, 3e-7F);
  EXPECT_NEAR(atan2_rad(1, -1), 0.75F * kPi, 3e-7F);
  EXPECT_NEAR(atan2_rad(-1, -1), -0.75F * kPi, 3e-7F);
  EXPECT_NEAR(atan2_rad(-1, 1), -0.25F * kPi, 3e-7F);
}

TEST(Atan2, IsOddInY) {
  for (int i = 1; i < 2000; ++i) {
    const float y = static_cast<float>(i) * 0.013F;
    EXPECT_EQ(atan2_rad(-y, -1.7F), -atan2_rad(y, -1.7F));
    EXPECT_EQ(atan2_rad(-y, 1.7F), -atan2_rad(y, 1.7F));
  }
}

TEST(Atan2, TurnsBackWhatSinCosTurned) {
  for (std::int64_t angle = -3'141'000; angle <= 3'141'000; angle += 61) {
    const SinCos direction = sincos_urad(angle);
    EXPECT_NEAR(static_cast<double>(atan2_rad(direction.sin, direction.cos)), static_cast<double>(angle) * 1e-6, 5e-7);
  }
}

// Golden: from this code on x86-64 with g++ 12.2 and clang 14. It changes only with the coefficients, on purpose;
// every recorded digest changes with it.
TEST(Trig, KeepsItsBits) { EXPECT_EQ(probe::trig_digest(), 0x3857637a744de1e4ULL); }

}  // namespace
}  // namespace fencepost::base
