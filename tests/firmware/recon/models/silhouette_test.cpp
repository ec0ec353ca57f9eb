#include "firmware/recon/models/silhouette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "firmware/recon/models/hybrid/node_directions.hpp"

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::recon {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kSigma = 0.004F;

Vec2 unit(float angle) { return {std::cos(angle), std::sin(angle)}; }

/// The outline of a convex polygon, as a robot would keep it.
struct Kept {
  std::vector<std::int16_t> offsets;
  std::vector<std::uint8_t> sigmas;

  Kept(const std::vector<Vec2>& corners, std::size_t nodes) : sigmas(nodes, encode_sigma(kSigma)) {
    for (std::size_t k = 0; k < nodes; ++k) {
      const Vec2 normal = unit(2 * kPi * static_cast<float>(k) / static_cast<float>(nodes));
      float most = -1;
      for (const Vec2& corner : corners) most = std::max(most, normal.dot(corner));
      offsets.push_back(static_cast<std::int16_t>(std::lround(most / kOffsetStep)));
    }
  }
  [[nodiscard]] OutlineView view() const { return {offsets, sigmas}; }
};

/// Lowest and highest bearing of the corners, by looking at each of them.
std::array<float, 2> bearings(const std::vector<Vec2>& corners, const Vec2& lens, const LensPose& pose) {
  std::array<float, 2> range{kPi, -kPi};
  for (const Vec2& corner : corners) {
    const Vec2 seen = to_camera(pose, corner - lens);
    const float bearing = std::atan2(seen.y(), seen.x());
    range = {std::min(range[0], bearing), std::max(range[1], bearing)};
  }
  return range;
}

float bearing_of(const TouchPoint& touch) { return std::atan2(touch.at.y(), touch.at.x()); }

const std::vector<Vec2> kBox{{0.12F, -0.05F}, {0.12F, 0.05F}, {-0.12F, 0.05F}, {-0.12F, -0.05F}};

TEST(Silhouette, OfACylinderIsItsTangents) {
  CylinderEstimate cylinder;
  cylinder.center = {1.0F, 0.3F};
  cylinder.radius = 0.1F;
  cylinder.covariance = {1e-4F, 0, 4e-4F, 0, 0, 0};
  LensPose pose;
  pose.axis = unit(std::atan2(0.3F, 1.0F));  // straight at it
  Silhouette seen;
  ASSERT_TRUE(render(cylinder, {0, 0}, pose, 0.01F, seen));
  const float distance = std::sqrt(1.09F);
  EXPECT_NEAR(bearing_of(seen.left), std::asin(0.1F / distance), 1e-6F);
  EXPECT_NEAR(bearing_of(seen.right), -std::asin(0.1F / distance), 1e-6F);
  EXPECT_NEAR(seen.left.at.norm(), std::sqrt(distance * distance - 0.01F), 1e-6F);
  EXPECT_NEAR(seen.depth, distance - 0.1F, 1e-6F);
  const float across = std::atan2(0.3F, 1.0F) + std::asin(0.1F / distance) + kPi / 2;
  EXPECT_NEAR(seen.left.variance,
              1e-4F * std::cos(across) * std::cos(across) + 4e-4F * std::sin(across) * std::sin(across) + 0.01F, 1e-8F);
}

TEST(Silhouette, OfAnOutlineIsItsOutermostCornersFromEverywhere) {
  for (const std::size_t nodes : {64U, 32U}) {
    const Kept kept(kBox, nodes);
    for (int step = 0; step < 360; ++step) {
      const float around = static_cast<float>(step) * kPi / 180;
      const Vec2 lens = (0.2F + 0.01F * static_cast<float>(step)) * unit(around);
      LensPose pose;
      pose.axis = unit(around + kPi + 0.1F);
      Silhouette seen;
      ASSERT_TRUE(render(kept.view(), lens, pose, 1e-6F, seen)) << step;
      const auto [right, left] = bearings(kBox, lens, pose);
      const float rounding = 3e-4F / seen.left.at.norm();  // whole steps of 0.1 mm, between sides that hardly turn
      EXPECT_NEAR(bearing_of(seen.left), left, 5 * rounding) << step;
      EXPECT_NEAR(bearing_of(seen.right), right, 5 * rounding) << step;
      EXPECT_NEAR(seen.left.variance, kSigma * kSigma + 1e-6F, 2e-6F);
      float nearest = 10;
      for (const Vec2& corner : kBox) nearest = std::min(nearest, pose.axis.dot(corner - lens));
      const float turned = kPi / static_cast<float>(nodes) * 0.13F;  // the axis lies between two nodes
      EXPECT_NEAR(seen.depth, nearest, turned + 1e-3F) << step;
    }
  }
}

TEST(Silhouette, IsToldByEndWhichIsKnownWorse) {
  Kept kept(kBox, 64);
  for (std::size_t k = 8; k < 24; ++k) kept.sigmas[k] = encode_sigma(0.03F);  // the sides that look to +y
  LensPose pose;
  Silhouette seen;
  ASSERT_TRUE(render(kept.view(), {-1, 0}, pose, 0, seen));
  EXPECT_NEAR(std::sqrt(seen.left.variance), 0.03F, 1e-3F);
  EXPECT_NEAR(std::sqrt(seen.right.variance), kSigma, 2e-4F);
}

TEST(Silhouette, IsNoneFromInsideFromBehindAndFromTooFar) {
  const Kept kept(kBox, 64);
  CylinderEstimate cylinder;
  cylinder.radius = 0.1F;
  LensPose pose;
  Silhouette seen;
  seen.depth = 7;
  EXPECT_FALSE(render(kept.view(), {0.01F, 0.02F}, pose, 0, seen));
  EXPECT_FALSE(render(kept.view(), {1, 0}, pose, 0, seen));
  EXPECT_FALSE(render(kept.view(), {-7, 0}, pose, 0, seen));
  EXPECT_FALSE(render(cylinder, {0.01F, 0.02F}, pose, 0, seen));
  EXPECT_FALSE(render(cylinder, {1, 0}, pose, 0, seen));
  EXPECT_EQ(seen.depth, 7);
  EXPECT_TRUE(render(kept.view(), {-5, 0}, pose, 0, seen));
}

TEST(NodeDirections, NearestNodeIsTheNearestOfAll) {
  for (const std::size_t nodes : {64U, 32U}) {
    for (int step = 0; step < 3600; ++step) {
      const Vec2 direction = unit(static_cast<float>(step) * kPi / 1800);
      float most = -2;
      for (std::size_t k = 0; k < nodes; ++k) most = std::max(most, direction.dot(node_direction(k, nodes)));
      const std::size_t nearest = nearest_node(direction, nodes);
      ASSERT_LT(nearest, nodes);
      EXPECT_NEAR(direction.dot(node_direction(nearest, nodes)), most, 1e-4F) << step;
    }
  }
}

// From a lattice of places, at an outline and at a circle: both kinds refuse at their bounds.
TEST(Silhouette, OfPlacesOnALattice) {
  test::Draw draw(91);
  test::Sweep sweep;
  Kept kept(kBox, 32);
  for (std::size_t k = 0; k < 32; ++k) kept.sigmas[k] = static_cast<std::uint8_t>(20 + 5 * k);
  const auto tell = [&](bool seen, const Silhouette& silhouette) {
    sweep.tell("seen", seen);
    if (!seen) return;
    sweep.tell("left", silhouette.left.at.x() + 8 * silhouette.left.at.y());
    sweep.tell("right", silhouette.right.at.x() + 8 * silhouette.right.at.y());
    sweep.tell("left variance", silhouette.left.variance);
    sweep.tell("right variance", silhouette.right.variance);
    sweep.tell("depth", silhouette.depth);
  };
  for (int i = 0; i < 10'000; ++i) {
    const bool near = draw.coin();
    const Vec2 lens{draw.steps(-26, 26, near ? 0.0078125F : 0.25F), draw.steps(-26, 26, near ? 0.0078125F : 0.25F)};
    LensPose pose;
    pose.axis = draw.of<Vec2>({{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.6F, 0.8F}, {-0.8F, 0.6F}});
    Silhouette seen;
    tell(render(kept.view(), lens, pose, 0.0001F, seen), seen);
    CylinderEstimate circle;
    circle.center = {draw.steps(-2, 2, 0.0625F), 0};
    circle.radius = draw.of({0.0F, 0.0625F, 0.25F});
    circle.covariance = {1e-4F, 2e-5F, 4e-4F, 1e-5F, 0, 1e-4F};
    tell(render(circle, lens, pose, 0.0001F, seen), seen);
  }
  expect_said(sweep, {"seen 7178 a323bed0", "left 7176 2814a99d", "right 7176 aef99d9b", "left variance 7178 911f9d5e",
                      "right variance 7178 e4728872", "depth 7178 77978021"});
}

// 1.01 radii away a lens is still inside, a float more and it is not; so are 6 m too far for an outline.
TEST(Silhouette, RefusesAtItsBounds) {
  CylinderEstimate circle;
  circle.radius = 0.25F;
  const float inside = circle.radius * 1.01F;
  const LensPose pose;
  Silhouette seen;
  EXPECT_FALSE(render(circle, {-inside, 0}, pose, 0, seen));
  EXPECT_TRUE(render(circle, {-std::nextafter(inside, 1.0F), 0}, pose, 0, seen));
  circle.radius = 0;
  EXPECT_FALSE(render(circle, {-0.001F, 0}, pose, 0, seen));
  EXPECT_TRUE(render(circle, {-0.00100001F, 0}, pose, 0, seen));
  const Kept kept(kBox, 64);
  EXPECT_FALSE(render(kept.view(), {-6, 0}, pose, 0, seen));
  EXPECT_TRUE(render(kept.view(), {std::nextafter(-6.0F, 0.0F), 0}, pose, 0, seen));
}

}  // namespace
}  // namespace fencepost::recon
