#include "host/models/outline_batch.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::test {
namespace {

using namespace recon;

using Wide = Hybrid<kRing>;

float uniform(std::mt19937& random, float low, float high) {
  return low + (high - low) * static_cast<float>(random() >> 8U) * 0x1p-24F;
}

/// A hybrid that any log might have left, or none: circles of 1 cm to 1.5 m with noise, outliers, gaps and lower
/// bounds. Some are wild: their tangents contradict each other.
Wide any_hybrid(std::mt19937& random) {
  Wide hybrid;
  hybrid.clusters.fill({});
  hybrid.origin = {static_cast<std::int32_t>(random() % 100'000), -static_cast<std::int32_t>(random() % 100'000)};
  hybrid.views = static_cast<std::uint8_t>(kViewsForPolygon + random() % 200);
  hybrid.refusal = random() % 4 == 0 ? HybridRefusal::kNoTangents : HybridRefusal::kNone;
  hybrid.new_weight = true;
  for (std::int16_t& offset : hybrid.offsets) offset = static_cast<std::int16_t>(random() % 2000);
  for (std::uint8_t& sigma : hybrid.sigmas) sigma = static_cast<std::uint8_t>(random() % 256);
  const float radius = random() % 3 == 0 ? uniform(random, 0.3F, 1.5F) : uniform(random, 0.01F, 0.3F);
  const float noise = uniform(random, 0, 0.2F) * radius;
  const Vec2 middle{uniform(random, -0.1F, 0.1F), uniform(random, -0.1F, 0.1F)};
  const std::size_t used = random() % 101;
  const bool wild = random() % 8 == 0;
  for (std::size_t i = 0; i < hybrid.clusters.size(); ++i) {
    if (random() % 100 >= used) continue;
    Cluster cluster;
    const Vec2 direction = node_direction(i / kClustersPerSector, kRing);
    cluster.offset = radius + direction.dot(middle) + uniform(random, -noise, noise);
    if (random() % 16 == 0) cluster.offset += uniform(random, -0.5F, 0.5F);
    if (wild) cluster.offset = uniform(random, -3, 3);
    cluster.phase = uniform(random, 0.01F, 0.99F);
    cluster.sigma = wild ? uniform(random, kSmallestSigma, 6) : uniform(random, kSmallestSigma, 0.02F);
    cluster.views = uniform(random, 0.2F, 31);
    cluster.lower_bound = random() % 6 == 0;
    EXPECT_TRUE(pack(cluster, hybrid.clusters[i]));
  }
  return hybrid;
}

std::vector<unsigned char> bytes(const Wide& hybrid) {
  std::vector<unsigned char> all(sizeof hybrid);
  std::memcpy(all.data(), &hybrid, sizeof hybrid);
  return all;
}

// The plain form fits one outline after the other: whoever has a batch must not be able to tell.
TEST(OutlineBatch, HasTheBitsOfTheSolver) {
  if (!base::kLaneVectors) GTEST_SKIP() << "nobody uses it here";
  std::mt19937 random(41);
  HybridSolver<64, 3> solver;
  int fitted = 0;
  int moved = 0;
  for (int batch_number = 0; batch_number < 400; ++batch_number) {
    std::vector<Wide> together;
    std::vector<float> known_radii;
    const std::size_t size = 1 + random() % kLanes;
    for (std::size_t i = 0; i < size; ++i) {
      together.push_back(any_hybrid(random));
      known_radii.push_back(random() % 3 == 0 ? uniform(random, 0.02F, 0.4F) : 0.0F);
    }
    std::vector<Wide> alone = together;
    OutlineBatch batch;
    for (std::size_t i = 0; i < size; ++i) batch.add(together[i], known_radii[i]);
    EXPECT_EQ(batch.full(), size == kLanes);
    batch.solve();
    for (std::size_t i = 0; i < size; ++i) {
      const MapPoint before = alone[i].origin;
      solver.solve(alone[i], known_radii[i]);
      ASSERT_EQ(bytes(together[i]), bytes(alone[i])) << batch_number << " " << i;
      fitted += alone[i].ok() ? 1 : 0;
      moved += alone[i].origin == before ? 0 : 1;
    }
  }
  EXPECT_GT(fitted, 500);
  EXPECT_GT(moved, 100);
}

// Used again it remembers nothing.
TEST(OutlineBatch, BeginsAnew) {
  std::mt19937 random(42);
  OutlineBatch batch;
  HybridSolver<64, 3> solver;
  for (int i = 0; i < 20; ++i) {
    Wide hybrid = any_hybrid(random);
    Wide other = hybrid;
    batch.add(hybrid, 0);
    batch.solve();
    batch.solve();  // nothing is in it
    solver.solve(other);
    ASSERT_EQ(bytes(hybrid), bytes(other)) << i;
  }
}

// A fit with few views stays a series of low order: not for a batch.
TEST(OutlineBatch, TakesWhatBecomesAPolygon) {
  Wide hybrid;
  hybrid.views = kViewsForPolygon;
  EXPECT_TRUE(OutlineBatch::takes(hybrid));
  --hybrid.views;
  EXPECT_FALSE(OutlineBatch::takes(hybrid));
}

/// One direction, known far better than anything else: a series that no solver finds.
Wide ill_conditioned_series(std::mt19937& random) {
  Wide hybrid = any_hybrid(random);
  hybrid.refusal = HybridRefusal::kNoTangents;
  hybrid.clusters.fill({});
  const std::size_t diagonal = kClustersPerSector * (kRing / 8 + kRing / 4 * (random() % 4));
  EXPECT_TRUE(pack({uniform(random, -0.5F, 0.5F), 0.01F, kSmallestSigma, 31, false}, hybrid.clusters[diagonal]));
  return hybrid;
}

/// A large circle: pivots of the ring get lost. Its residuals are all far smaller than sigmas say, and a few tangents
/// are known far better than sides are.
Wide ill_conditioned_ring(std::mt19937& random) {
  Wide hybrid = any_hybrid(random);
  hybrid.clusters.fill({});
  for (std::size_t sector = 0; sector < kRing; ++sector) {
    const float sigma = random() % 8 == 0 ? kSmallestSigma : 0.05F;
    EXPECT_TRUE(pack({0.4F, 0.5F, sigma, 31, false}, hybrid.clusters[sector * kClustersPerSector]));
  }
  return hybrid;
}

// An ill-conditioned hybrid is given up in the same step, and its neighbours in the batch do not notice.
TEST(OutlineBatch, LosesNobodysNeighbour) {
  if (!base::kLaneVectors) GTEST_SKIP() << "nobody uses it here";
  std::mt19937 random(43);
  HybridSolver<64, 3> solver;
  int lost = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<Wide> together{any_hybrid(random), ill_conditioned_series(random), any_hybrid(random),
                               ill_conditioned_ring(random)};
    std::vector<Wide> alone = together;
    OutlineBatch batch;
    for (Wide& hybrid : together) batch.add(hybrid, 0);
    batch.solve();
    for (std::size_t k = 0; k < together.size(); ++k) {
      solver.solve(alone[k]);
      ASSERT_EQ(bytes(together[k]), bytes(alone[k])) << i << " " << k;
    }
    lost += alone[1].refusal == HybridRefusal::kIllConditioned ? 1 : 0;
  }
  EXPECT_GT(lost, 50);
}

}  // namespace
}  // namespace fencepost::test
