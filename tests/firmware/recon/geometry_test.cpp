#include "firmware/recon/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace fencepost::test {
namespace {

using recon::Vec2;

// Copied by memcpy, several at a time (bounds_of).
static_assert(std::is_trivially_copyable_v<Vec2> && std::is_trivial_v<Vec2> && sizeof(Vec2) == 2 * sizeof(float));

const Vec2 kA{3, -4};
const Vec2 kB{0.5F, 2};

TEST(Vec2, ComputesByComponents) {
  EXPECT_EQ(Vec2{}, Vec2(0, 0));
  EXPECT_EQ(Vec2(0, 0), Vec2(-0.0F, 0));
  EXPECT_NE(kA, Vec2(3, 4));
  EXPECT_NE(kA, Vec2(-3, -4));
  EXPECT_EQ(kA + kB, Vec2(3.5F, -2));
  EXPECT_EQ(kA - kB, Vec2(2.5F, -6));
  EXPECT_EQ(-kA, Vec2(-3, 4));
  EXPECT_EQ(kA * 2, Vec2(6, -8));
  EXPECT_EQ(2 * kA, Vec2(6, -8));
  EXPECT_EQ(kA / 2, Vec2(1.5F, -2));
  EXPECT_EQ(kA.dot(kB), -6.5F);
  EXPECT_EQ(kA.squared_norm(), 25);
  EXPECT_EQ(kA.max_norm(), 4);
  EXPECT_EQ(kB.max_norm(), 2);
  EXPECT_EQ((-kB).max_norm(), 2);
  EXPECT_EQ(recon::cross(kA, kB), 8);
  EXPECT_EQ(recon::left_of(kA), Vec2(4, 3));
}

TEST(Vec2, ChangesInPlace) {
  Vec2 v = kA;
  EXPECT_EQ(v += kB, kA + kB);
  EXPECT_EQ(v -= kB, kA);
  EXPECT_EQ(v *= 3, (Vec2{9, -12}));
  EXPECT_EQ(v /= 3, kA);
  v.x() = 1;
  v.y() += 1;
  EXPECT_EQ(v, (Vec2{1, -3}));
}

// To the bit: the digests depend on the order of these operations.
TEST(Vec2, NormIsTheRootOfTheSumAndDividesBothCoordinates) {
  const Vec2 v{0.1F, 0.7F};
  const float norm = std::sqrt(0.1F * 0.1F + 0.7F * 0.7F);
  EXPECT_EQ(v.norm(), norm);
  EXPECT_EQ(v.normalized(), (Vec2{0.1F / norm, 0.7F / norm}));
}

}  // namespace
}  // namespace fencepost::test
