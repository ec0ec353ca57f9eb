#include "firmware/recon/models/hybrid/cyclic_band.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace fencepost::test {
namespace {

// Matrices of any size up to the largest here: the build forbids Eigen the heap.
using DenseMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 64, 64>;
using DenseVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 64, 1>;

using recon::CyclicBand;
using recon::kRing;

DenseMatrix dense(const CyclicBand& band) {
  DenseMatrix a = DenseMatrix::Zero(kRing, kRing);
  for (std::size_t k = 0; k < kRing; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const auto one = static_cast<Eigen::Index>((k + 1) % kRing);
    const auto two = static_cast<Eigen::Index>((k + 2) % kRing);
    a(i, i) = static_cast<double>(band.diagonal[k]);
    a(i, one) = a(one, i) = static_cast<double>(band.first[k]);
    a(i, two) = a(two, i) = static_cast<double>(band.second[k]);
  }
  return a;
}

DenseVector right_side(const CyclicBand& band) {
  DenseVector b(kRing);
  for (std::size_t k = 0; k < kRing; ++k) b(static_cast<Eigen::Index>(k)) = static_cast<double>(band.rhs[k]);
  return b;
}

bool solve(CyclicBand& band) {
  band.begin_elimination();
  for (std::size_t k = 0; k < kRing; ++k) {
    if (!band.eliminate(k)) return false;
  }
  for (std::size_t k = kRing; k-- > 0;) band.substitute(k);
  return true;
}

/// Sum of w v v' over stencils of three neighbours, like the fit's, plus `floor` on the diagonal: positive definite.
CyclicBand random_system(std::mt19937& random, float floor) {
  std::uniform_real_distribution<float> any(-1, 1);
  CyclicBand band;
  band.diagonal.fill(floor);
  for (std::size_t k = 0; k < kRing; ++k) {
    const std::size_t one = (k + 1) % kRing;
    const std::size_t two = (k + 2) % kRing;
    const float a = any(random), b = any(random), c = any(random);
    const float weight = 10 + 9 * any(random);
    band.diagonal[k] += weight * a * a;
    band.diagonal[one] += weight * b * b;
    band.diagonal[two] += weight * c * c;
    band.first[k] += weight * a * b;
    band.first[one] += weight * b * c;
    band.second[k] += weight * a * c;
    band.rhs[k] = any(random);
  }
  return band;
}

TEST(CyclicBand, SolvesAsTheDenseSolverInDoubleDoes) {
  std::mt19937 random(7);
  for (int run = 0; run < 200; ++run) {
    CyclicBand band = random_system(random, 0.5F);
    const DenseVector exact = dense(band).ldlt().solve(right_side(band));
    ASSERT_TRUE(solve(band));
    for (std::size_t k = 0; k < kRing; ++k) {
      EXPECT_NEAR(static_cast<double>(band.rhs[k]), exact(static_cast<Eigen::Index>(k)), 2e-5 * exact.norm()) << run;
    }
  }
}

// Every entry has a part in the solution: with one coupling changed the answer is another one.
TEST(CyclicBand, EveryCouplingCounts) {
  std::mt19937 random(11);
  const CyclicBand base = random_system(random, 5.0F);
  for (std::size_t k = 0; k < kRing; ++k) {
    for (const bool second : {false, true}) {
      CyclicBand band = base;
      (second ? band.second : band.first)[k] += 0.8F;
      const DenseVector exact = dense(band).ldlt().solve(right_side(band));
      ASSERT_TRUE(solve(band));
      double off = 0;
      for (std::size_t i = 0; i < kRing; ++i) {
        off = std::max(off, std::abs(static_cast<double>(band.rhs[i]) - exact(static_cast<Eigen::Index>(i))));
      }
      EXPECT_LT(off, 1e-5 * exact.norm()) << k << second;
    }
  }
}

TEST(CyclicBand, RefusesWhatIsSingular) {
  CyclicBand nothing;
  EXPECT_FALSE(solve(nothing));
  // Second differences around the ring: constants and nothing else are in the null space.
  CyclicBand band;
  for (std::size_t k = 0; k < kRing; ++k) {
    band.diagonal[k] = 6;
    band.first[k] = -4;
    band.second[k] = 1;
    band.rhs[k] = 1;
  }
  EXPECT_NEAR(dense(band).ldlt().vectorD().minCoeff(), 0, 1e-9);
  CyclicBand held = band;
  EXPECT_FALSE(solve(band));
  for (float& entry : held.diagonal) entry += 1;
  EXPECT_TRUE(solve(held));
  EXPECT_NEAR(held.rhs[17], 1, 1e-4);  // sum of the row is 1
}

TEST(CyclicBand, RefusesWhatIsNotPositive) {
  std::mt19937 random(3);
  for (std::size_t k = 0; k < kRing; ++k) {
    CyclicBand band = random_system(random, 0.5F);
    band.diagonal[k] = -band.diagonal[k];
    EXPECT_FALSE(solve(band)) << k;
  }
}

}  // namespace
}  // namespace fencepost::test
