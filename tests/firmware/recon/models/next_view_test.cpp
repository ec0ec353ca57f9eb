#include "firmware/recon/models/next_view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace fencepost::recon {
namespace {

constexpr float kBody = 0.15F;
constexpr float kRadius = 0.1F;

/// A round outline of 0.1 m, known to 4 mm, with a tangent in the middle of each of these sectors.
template <std::size_t kNodes>
struct Outline {
  explicit Outline(const std::vector<std::size_t>& sectors) {
    offsets.fill(1'000);
    sigmas.fill(encode_sigma(0.004F));
    for (const std::size_t sector : sectors) {
      const Cluster cluster{kRadius, 0.5F, 0.004F, 1, false};
      EXPECT_TRUE(pack(cluster, clusters[kClustersPerSector * sector]));
    }
  }
  [[nodiscard]] NextView next(const Vec2& robot, std::span<const Disc> others = {}) const {
    return next_view({offsets, sigmas}, clusters, robot, others, kBody);
  }
  std::array<std::int16_t, kNodes> offsets{};
  std::array<std::uint8_t, kNodes> sigmas{};
  std::array<PackedCluster, kClustersPerSector * kNodes> clusters{};
};

/// Tangents all around, one in `each` sectors, but for those from `from` to `to`.
std::vector<std::size_t> all_but(std::size_t nodes, std::size_t each, std::size_t from, std::size_t to) {
  std::vector<std::size_t> sectors;
  for (std::size_t k = 0; k < nodes; k += each) {
    if (k < from || k > to) sectors.push_back(k);
  }
  return sectors;
}

double degrees(const NextView& next) {
  return static_cast<double>(std::atan2(next.toward.y(), next.toward.x())) * 180 / std::numbers::pi;
}

TEST(NextView, FillsTheGap) {
  // No tangent between 56 and 124 degrees. A normal of 90 degrees is that of views from 0 or 180, some 7 degrees less.
  const Outline<64> outline(all_but(64, 2, 11, 21));
  const NextView next = outline.next({0.8F, 0.3F});
  ASSERT_TRUE(next.ok());
  EXPECT_NEAR(degrees(next), 0, 16);
  EXPECT_NEAR(next.place.norm(), std::hypot(0.8F, 0.3F), 1e-4F);
  EXPECT_NEAR(std::abs(degrees(outline.next({-0.8F, 0.3F}))), 180, 16) << "the nearer one of two";
}

TEST(NextView, ALargerGapGainsMore) {
  const NextView small = Outline<64>(all_but(64, 2, 14, 18)).next({0.8F, 0});
  const NextView large = Outline<64>(all_but(64, 2, 9, 23)).next({0.8F, 0});
  EXPECT_GT(large.gain, 1.5F * small.gain);
  EXPECT_LT(large.gain, 0.5F);
  EXPECT_LT(large.width, 2.5F);
}

TEST(NextView, WhereTangentsMeetInACornerNothingIsGained) {
  // The tangents beside the gap, and those beside them, all go through one point at 90 degrees.
  const Outline<64> round(all_but(64, 2, 11, 21));
  Outline<64> pointed = round;
  const double corner = 1'150;  // tenths of a millimetre
  for (std::size_t node = 8; node <= 25; ++node) {
    const double direction = 2 * std::numbers::pi * static_cast<double>(node) / 64;
    pointed.offsets[node] = static_cast<std::int16_t>(std::lround(corner * std::sin(direction)));
  }
  EXPECT_LT(pointed.next({0.8F, 0}).gain, 0.5F * round.next({0.8F, 0}).gain);
}

TEST(NextView, NobodyStandsInAnotherObject) {
  const Outline<64> outline(all_but(64, 2, 11, 21));
  const std::array<Disc, 1> there{{{{0.8F, 0}, 0.2F}}};
  const NextView next = outline.next({0.8F, 0}, there);
  ASSERT_TRUE(next.ok());
  EXPECT_GE((next.place - there[0].center).norm(), 0.35F - 1e-4F);
  const std::array<Disc, 1> all_around{{{{0, 0}, 2.0F}}};
  EXPECT_EQ(outline.next({0.8F, 0}, all_around).refusal, NextViewRefusal::kBlocked);
}

TEST(NextView, TheSmallestPartsOutlineGivesTheSame) {
  const NextView next = Outline<32>(all_but(32, 1, 6, 10)).next({0.8F, 0.3F});
  ASSERT_TRUE(next.ok());
  EXPECT_NEAR(degrees(next), 0, 24);
}

TEST(NextView, NeedsTangents) {
  EXPECT_EQ(Outline<64>({}).next({0.8F, 0}).refusal, NextViewRefusal::kNoOutline);
  EXPECT_EQ(Outline<64>({3}).next({0.8F, 0}).refusal, NextViewRefusal::kNoOutline);
}

TEST(NextView, DistancesAreThoseAtWhichEdgesAreSeenWell) {
  const Outline<64> outline(all_but(64, 2, 11, 21));
  EXPECT_NEAR(outline.next({5, 0}).place.norm(), kFarthestView, 1e-4F);
  EXPECT_NEAR(outline.next({0.1F, 0}).place.norm(), kNearestView, 1e-4F);
  EXPECT_TRUE(outline.next({0, 0}).ok()) << "on its middle: no direction is behind it";
}

}  // namespace
}  // namespace fencepost::recon
