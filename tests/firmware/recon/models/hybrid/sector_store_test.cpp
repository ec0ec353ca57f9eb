#include "firmware/recon/models/hybrid/sector_store.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using namespace recon;

using Store = std::array<PackedCluster, 64 * kClustersPerSector>;

Vec2 unit_at(double angle) { return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}; }

/// In sector 10 of 64, in its middle.
constexpr SectorPlace kPlace{10, 0.5F};

Tangent tangent(float offset, float sigma = 0.01F) { return {{direction_of(kPlace, 64), offset}, sigma}; }

Cluster stored(const Store& store, std::size_t which) {
  return unpack(store[kPlace.sector * kClustersPerSector + which]);
}

TEST(NodeDirections, AreCosinesAndSines) {
  for (const std::size_t nodes : {32U, 64U}) {
    for (std::size_t k = 0; k < nodes; ++k) {
      const Vec2 exact = unit_at(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(nodes));
      EXPECT_LT((node_direction(k, nodes) - exact).norm(), 1e-7F) << k;
    }
    EXPECT_NEAR(node_step(nodes).sine, std::sin(2 * std::numbers::pi / static_cast<double>(nodes)), 1e-7);
    EXPECT_NEAR(node_step(nodes).cosine, std::cos(2 * std::numbers::pi / static_cast<double>(nodes)), 1e-7);
  }
  for (int i = 0; i <= 200; ++i) {
    const double angle = 1e-3 * i;
    EXPECT_NEAR(small_sine(static_cast<float>(angle)), std::sin(angle), 1e-7);
    EXPECT_NEAR(small_cosine(static_cast<float>(angle)), std::cos(angle), 1e-7);
  }
}

TEST(SectorStore, PlacesEveryDirection) {
  for (int i = 0; i < 3600; ++i) {
    const Vec2 direction = unit_at(2 * std::numbers::pi * (i + 0.3) / 3600);
    for (const std::size_t sectors : {32U, 64U}) {
      const SectorPlace place = place_of(direction, sectors);
      ASSERT_LT(place.sector, sectors);
      EXPECT_EQ(place.sector, static_cast<std::size_t>((i + 0.3) * static_cast<double>(sectors) / 3600)) << i;
      EXPECT_LT((direction_of(place, sectors) - direction).norm(), 1e-4F) << i;
    }
  }
}

TEST(SectorStore, SigmasKeepFourPerCent) {
  for (double sigma = 1e-4; sigma < 6; sigma *= 1.003) {
    const auto back = static_cast<double>(decode_sigma(encode_sigma(static_cast<float>(sigma))));
    EXPECT_NEAR(back / sigma, 1, 0.032) << sigma;
  }
  EXPECT_NEAR(decode_sigma(encode_sigma(0)), kSmallestSigma, 1e-9);
  EXPECT_NEAR(decode_sigma(encode_sigma(1e9F)), 6.0F, 0.2F);
  for (unsigned code = 0; code < 256; ++code) {  // a fixed point: storing again changes nothing
    if (decode_sigma(static_cast<std::uint8_t>(code)) > 6.0F) continue;
    EXPECT_EQ(encode_sigma(decode_sigma(static_cast<std::uint8_t>(code))), code);
  }
}

TEST(SectorStore, ClustersLoseHalfAStepAtMost) {
  for (int i = -300; i <= 300; ++i) {
    const Cluster cluster{0.0107F * static_cast<float>(i), 0.37F, 0.0123F, 2.2F, i % 2 == 0};
    PackedCluster packed;
    ASSERT_TRUE(pack(cluster, packed));
    const Cluster back = unpack(packed);
    EXPECT_NEAR(back.offset, cluster.offset, 0.51F * kOffsetStep);
    EXPECT_NEAR(back.phase, cluster.phase, 0.51F / 128);
    EXPECT_NEAR(back.views, cluster.views, 0.51F * kViewsStep);
    EXPECT_EQ(back.lower_bound, cluster.lower_bound);
  }
  PackedCluster packed;
  EXPECT_FALSE(pack({3.28F, 0.5F, 0.01F, 1}, packed));
  EXPECT_FALSE(pack({-3.28F, 0.5F, 0.01F, 1}, packed));
  EXPECT_EQ(packed.views, 0);
}

// Two tangents of sigmas 10 and 20 mm: information 1 and 1/4, so the mean is 4/5 of the first and 1/5 of the second.
TEST(SectorStore, AgreeingTangentsMakeOneMean) {
  Store store{};
  insert(store, kPlace, tangent(0.100F, 0.010F), 1, {});
  insert(store, kPlace, tangent(0.110F, 0.020F), 1, {});
  EXPECT_NEAR(stored(store, 0).offset, 0.102F, 1e-4F);
  EXPECT_FLOAT_EQ(stored(store, 0).views, 2);
  // sigma^2 = views / information = 2 / (1 / 0.01^2 + 1 / 0.02^2)
  EXPECT_NEAR(stored(store, 0).sigma, std::sqrt(2 / 12'500.0), 0.04 * 0.0126);
  EXPECT_EQ(stored(store, 1).views, 0);
}

TEST(SectorStore, SlopeCarriesATangentToTheClustersDirection) {
  Store store{};
  const float angle = node_step(64).angle;
  constexpr float kSlope = 0.5F;  // m/rad
  insert(store, {10, 0.2F}, tangent(0.100F), 1, {kSlope, 1});
  insert(store, {10, 0.8F}, tangent(0.100F + kSlope * 0.6F * angle), 1, {kSlope, 1});
  EXPECT_NEAR(stored(store, 0).phase, 0.5F, 0.005F);
  EXPECT_NEAR(stored(store, 0).offset, 0.100F + kSlope * 0.3F * angle, 2e-4F);
  EXPECT_EQ(stored(store, 1).views, 0);
}

TEST(SectorStore, AWrongTangentIsAClusterOfItsOwnAndIsOutlived) {
  Store store{};
  for (int i = 0; i < 4; ++i) insert(store, kPlace, tangent(0.10F), 1, {});
  insert(store, kPlace, tangent(0.02F), 1, {});  // a lost piece: smaller
  EXPECT_NEAR(stored(store, 0).offset, 0.10F, 1e-4F);
  EXPECT_FLOAT_EQ(stored(store, 0).views, 4);
  EXPECT_NEAR(stored(store, 1).offset, 0.02F, 1e-4F);
  EXPECT_EQ(standing(store, 2 * 10), 1.0F);
  EXPECT_FLOAT_EQ(standing(store, 2 * 10 + 1), 0.5F);  // the larger one has more views
  insert(store, kPlace, tangent(-0.05F), 1, {});       // another one takes its place
  EXPECT_NEAR(stored(store, 1).offset, -0.05F, 1e-4F);
  insert(store, kPlace, tangent(-0.05F), 1, {});
  insert(store, kPlace, tangent(0.30F), 1, {});  // two agree by now: they are weakened by half of one
  EXPECT_NEAR(stored(store, 1).offset, -0.05F, 1e-4F);
  EXPECT_FLOAT_EQ(stored(store, 1).views, 1.5F);
  EXPECT_FLOAT_EQ(stored(store, 0).views, 4);
}

Tangent lower_bound(float offset) {
  Tangent limit = tangent(offset);
  limit.lower_bound = true;
  return limit;
}

TEST(SectorStore, WhatSaysAtLeastStaysApartFromEdges) {
  Store store{};
  insert(store, kPlace, lower_bound(0.10F), 1, {});
  insert(store, kPlace, lower_bound(0.10F), 1, {});
  insert(store, kPlace, tangent(0.10F), 1, {});
  EXPECT_TRUE(stored(store, 0).lower_bound);
  EXPECT_FLOAT_EQ(stored(store, 0).views, 2);
  EXPECT_FALSE(stored(store, 1).lower_bound);
  EXPECT_FLOAT_EQ(stored(store, 1).views, 1);
  EXPECT_EQ(standing(store, 2 * 10), 1.0F);
}

TEST(SectorStore, WhatSaysAtLeastIsNoNewsWhereAnEdgeIsThatFarOut) {
  Store store{};
  insert(store, kPlace, tangent(0.10F), 1, {});
  insert(store, kPlace, lower_bound(0.105F), 1, {});  // sigma is 10 mm
  EXPECT_EQ(stored(store, 1).views, 0);
  insert(store, kPlace, lower_bound(0.115F), 1, {});
  EXPECT_FLOAT_EQ(stored(store, 1).views, 1);
}

TEST(SectorStore, WhatSaysAtLeastOverrulesAnEdgeAndTakesNothingFromIt) {
  Store store{};
  insert(store, kPlace, tangent(0.02F), 1, {});
  for (int i = 0; i < 2; ++i) insert(store, kPlace, lower_bound(0.10F), 1, {});
  EXPECT_FLOAT_EQ(standing(store, 2 * 10), 0.5F);
  EXPECT_EQ(standing(store, 2 * 10 + 1), 1.0F);
  Store edges{};
  insert(edges, kPlace, tangent(0.02F), 1, {});
  insert(edges, kPlace, tangent(-0.05F), 0.5F, {});
  insert(edges, kPlace, lower_bound(0.10F), 1, {});
  EXPECT_NEAR(stored(edges, 0).offset, 0.02F, 1e-4F);
  EXPECT_FLOAT_EQ(stored(edges, 0).views, 1);
  EXPECT_NEAR(stored(edges, 1).offset, -0.05F, 1e-4F);
  EXPECT_FLOAT_EQ(stored(edges, 1).views, 0.5F);
}

TEST(SectorStore, OldViewsFade) {
  Store store{};
  for (int i = 0; i < 200; ++i) insert(store, kPlace, tangent(0.10F), 1, {});
  EXPECT_LE(stored(store, 0).views, kMaxClusterViews + 1);
  for (int i = 0; i < 60; ++i) insert(store, kPlace, tangent(0.115F), 1, {});
  EXPECT_GT(stored(store, 0).offset, 0.111F);  // 1 - (30/31)^60 = 86 % of the way
}

TEST(SectorStore, MovingTheOriginIsWhatItIsInFloats) {
  const OriginShift shift{-7310, 12'345};
  const Vec2 metres{-0.7310F, 1.2345F};
  for (const std::size_t sectors : {32U, 64U}) {
    std::vector<PackedCluster> store(sectors * kClustersPerSector);
    std::vector<float> expected;
    for (std::size_t i = 0; i < store.size(); ++i) {
      const Cluster cluster{0.1F, static_cast<float>(i * 37 % 256) / 256, 0.01F, 1, i % 3 == 0};
      ASSERT_TRUE(pack(cluster, store[i]));
      const Vec2 direction = direction_of({i / kClustersPerSector, unpack(store[i]).phase}, sectors);
      expected.push_back(0.1F - direction.dot(metres));
    }
    move_origin(store, shift);
    for (std::size_t i = 0; i < store.size(); ++i) EXPECT_NEAR(unpack(store[i]).offset, expected[i], 4e-4F) << i;
  }
}

TEST(SectorStore, WhatGetsOutOfRangeIsForgotten) {
  Store store{};
  ASSERT_TRUE(pack({3.0F, 0.5F, 0.01F, 5}, store[0]));
  move_origin(store, {-10'000, 0});
  EXPECT_EQ(store[0].views, 0);
}

Tangent at_least(float offset, float sigma = 0.01F) { return {{direction_of(kPlace, 64), offset}, sigma, true}; }

// The robot drives along something long: its lower bounds grow from view to view.
TEST(SectorStore, OfTwoLowerBoundsTheFartherOneStays) {
  Store store{};
  for (const float offset : {0.1F, 0.3F, 0.25F, 0.5F, 0.2F}) insert(store, kPlace, at_least(offset), 1, {});
  EXPECT_NEAR(stored(store, 0).offset, 0.5F, kOffsetStep);
  EXPECT_TRUE(stored(store, 0).lower_bound);
  EXPECT_EQ(stored(store, 1).views, 0);
}

TEST(SectorStore, AnUnsureEdgeDoesNotReplaceALowerBound) {
  Store store{};
  insert(store, kPlace, at_least(0.2F, 0.005F), 1, {});
  insert(store, kPlace, tangent(0.2F, 0.1F), 1, {});
  insert(store, kPlace, at_least(0.3F, 0.005F), 1, {});
  float bound = 0;
  for (const std::size_t which : {0U, 1U}) {
    if (stored(store, which).lower_bound) bound = stored(store, which).offset;
  }
  EXPECT_NEAR(bound, 0.3F, kOffsetStep);
}

TEST(SectorStore, ASideIsOpenWhereNoEdgeIsNear) {
  Store store{};
  const Vec2 normal = direction_of(kPlace, 64);
  EXPECT_FALSE(edge_seen(store, normal));
  insert(store, kPlace, at_least(0.2F), 1, {});
  EXPECT_FALSE(edge_seen(store, normal));
  insert(store, kPlace, tangent(0.4F), 1, {});
  EXPECT_TRUE(edge_seen(store, normal));
  EXPECT_TRUE(edge_seen(store, direction_of(SectorPlace{12, 0.5F}, 64)));
  EXPECT_FALSE(edge_seen(store, direction_of(SectorPlace{13, 0.5F}, 64)));
  EXPECT_FALSE(edge_seen(store, -normal));
}

void tell_clusters(Sweep& sweep, ConstClusters clusters) {
  base::Fnv1a64 hash;
  hash_clusters(hash, clusters);
  sweep.tell("clusters", static_cast<std::uint32_t>(hash.value()));
}

// Tangents on a lattice of offsets, sigmas and places of two neighbouring sectors. Some join, some take a place, some
// are dropped; the store's answers are compared after each.
TEST(SectorStore, OfTangentsOnALattice) {
  Draw draw(141);
  Sweep sweep;
  for (int run = 0; run < 400; ++run) {
    const std::size_t sectors = run % 3 == 0 ? 32 : 64;
    std::array<PackedCluster, 64 * kClustersPerSector> all{};
    const Clusters store = Clusters(all).first(sectors * kClustersPerSector);
    for (int i = 0; i < 24; ++i) {
      SectorPlace place{draw.of<std::size_t>({0, 10, 10, sectors - 1}), draw.of({0.0F, 0.25F, 0.5F, 0.5F, 0.998F})};
      const float bound = draw.of({0.125F, 0.125F, 0.13F, 0.135F, 0.14F, 0.15F, 0.0F, 3.2F, 3.3F, -3.3F});
      const Tangent tangent{{direction_of(place, sectors), bound}, draw.of({0.005F, 0.01F, 0.02F}), draw.one_in(3)};
      const StoreContext context{draw.of({0.0F, 0.0F, 0.0625F, -0.0625F}), draw.of({1.0F, 0.25F, 2.0F})};
      insert(store, place, tangent, draw.of({1.0F, 1.0F, 0.5F, 0.0625F}), context);
      tell_clusters(sweep, store);
      for (const std::size_t at : {0U, 10U}) {
        for (std::size_t which = 0; which < kClustersPerSector; ++which) {
          sweep.tell("standing", standing(store, at * kClustersPerSector + which));
        }
      }
      sweep.tell("edge", edge_seen(store, draw.of<Vec2>({{1, 0}, {0, 1}, {0.6F, 0.8F}, {0.5F, 0.8F}, {-1, 0}})));
    }
    move_origin(store, {draw.of({0, 100, -32'767, 32'767}), draw.of({0, -100, 7, 1'250})});
    tell_clusters(sweep, store);
  }
  expect_said(sweep, {"clusters 10000 b2540c30", "standing 38400 116a66f5", "edge 3932 d104fd96"});
}

TEST(SectorStore, OfNumbersThatAreItsBounds) {
  Sweep sweep;
  for (int i = 1; i < 4'000; ++i) {
    sweep.tell("sigma", encode_sigma(static_cast<float>(i) * 0.5F * kSigmaUnit));
    sweep.tell("large sigma", encode_sigma(static_cast<float>(i) * 512 * kSigmaUnit));
  }
  for (const int steps : {0, 1, 32'766, 32'767, 32'768}) {
    for (const float more : {-0.5F, -0.25F, 0.0F, 0.25F, 0.5F}) {
      for (const float sign : {1.0F, -1.0F}) {
        std::int32_t whole = 0;
        sweep.tell("fits", whole_steps(sign * kOffsetStep * (static_cast<float>(steps) + more), whole));
        sweep.tell("steps", whole);
      }
    }
  }
  for (const std::size_t sectors : {32U, 64U}) {
    for (int x = -4; x <= 4; ++x) {
      for (int y = -4; y <= 4; ++y) {
        if (x == 0 && y == 0) continue;
        const SectorPlace place = place_of({static_cast<float>(x), static_cast<float>(y)}, sectors);
        sweep.tell("sector", place.sector);
        sweep.tell("phase", place.phase);
        for (const int part : {0, 1, 255, 511}) {
          sweep.tell("change", change_of_offset({1'000 * x, -777 * y}, place.sector, part, sectors));
        }
      }
    }
  }
  expect_said(sweep, {"sigma 3967 646dcca6", "large sigma 3999 fd18db89", "fits 34 6cc592b7", "steps 28 740efa55",
                      "sector 152 f4d95c8a", "phase 96 5ac39a54", "change 640 d972a219"});
}

TEST(NodeDirections, GoRound) {
  for (std::size_t k = 0; k < 64; ++k) {
    EXPECT_EQ(direction_at(64 + k), direction_at(k)) << k;
    EXPECT_EQ(direction_at(128 + k), direction_at(k)) << k;
  }
}

}  // namespace
}  // namespace fencepost::test
