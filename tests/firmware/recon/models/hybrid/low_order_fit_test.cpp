#include "firmware/recon/models/hybrid/low_order_fit.hpp"
#include "firmware/config/profile.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/recon/models/inlier.hpp"

namespace fencepost::test {
namespace {

// Matrices of any size up to the largest here: the build forbids Eigen the heap.
using DenseVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 64, 1>;
using SingleMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, 0, 64, 64>;
using SingleVector = Eigen::Matrix<float, Eigen::Dynamic, 1, 0, 64, 1>;

using namespace recon;

bool factorise(std::span<float> matrix, std::size_t unknowns) {
  for (std::size_t i = 0; i < unknowns; ++i) {
    if (!factorise_row(matrix, i)) return false;
  }
  return true;
}

template <class Fit>
bool solve(Fit& fit) {
  fit.begin_solution();
  for (std::size_t i = 0; i < Fit::kUnknowns; ++i) {
    if (!fit.factorise(i)) return false;
  }
  fit.finish_pass(false);
  return true;
}

TEST(Inlier, IsTheMixtureOfTheText) {
  const auto exact = [](double e, double s) {
    const double good = 0.9 * std::exp(-0.5 * e * e / (s * s)) / (s * 2.5066283);
    const double bad = 0.1 * (e > 0 ? 0.25 : 1.0) / std::max(0.3, 7.52 * s);
    return good / (good + bad);
  };
  for (const double sigma : {0.002, 0.01, 0.03, 0.2}) {
    for (const double e : {-0.4, -0.05, -0.01, 0.0, 0.004, 0.03, 0.3}) {
      EXPECT_NEAR(inlier_share(static_cast<float>(e), static_cast<float>(sigma)), exact(e, sigma), 1e-4) << e << sigma;
    }
  }
}

TEST(SeriesBasis, AreMultiplesOfTheAngle) {
  std::array<float, 11> basis{};
  const double angle = 2.2;
  series_basis({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}, basis);
  EXPECT_EQ(basis[0], 1.0F);
  for (std::size_t m = 1; m <= 5; ++m) {
    EXPECT_NEAR(basis[2 * m - 1], std::cos(static_cast<double>(m) * angle), 1e-6);
    EXPECT_NEAR(basis[2 * m], std::sin(static_cast<double>(m) * angle), 1e-6);
  }
}

TEST(PackedCholesky, SolvesAsTheDenseSolverInDoubleDoes) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> any(-1, 1);
  for (const Eigen::Index n : {1, 3, 7, 11}) {
    for (int run = 0; run < 50; ++run) {
      SingleMatrix root(n, n);
      for (Eigen::Index i = 0; i < n * n; ++i) root(i) = any(random);
      const SingleMatrix a = root * root.transpose() + 0.3F * SingleMatrix::Identity(n, n);
      SingleVector b(n);
      for (Eigen::Index i = 0; i < n; ++i) b(i) = any(random);
      std::vector<float> packed;
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) packed.push_back(a(i, j));
      }
      const DenseVector exact = a.cast<double>().ldlt().solve(b.cast<double>());
      ASSERT_TRUE(factorise(packed, static_cast<std::size_t>(n)));
      const std::span<float> x(b.data(), static_cast<std::size_t>(n));
      solve_lower(packed, x);
      solve_upper(packed, x);
      for (Eigen::Index i = 0; i < n; ++i) EXPECT_NEAR(static_cast<double>(b(i)), exact(i), 1e-4 * exact.norm());
    }
  }
}

TEST(PackedCholesky, RefusesWhatIsSingular) {
  std::vector<float> same{4, 2, 1};  // (2, 1)(2, 1)'
  EXPECT_FALSE(factorise(same, 2));
  std::vector<float> nothing(6, 0.0F);
  EXPECT_FALSE(factorise(nothing, 3));
  std::vector<float> negative{1, 0, -1};
  EXPECT_FALSE(factorise(negative, 2));
}

// As each profile has it.
template <class Profile>
class LowOrder : public ::testing::Test {};
using Profiles = ::testing::Types<config::Full, config::Small, config::Micro>;
TYPED_TEST_SUITE(LowOrder, Profiles);

// Three tangents of a circle of 0.1 m around (0.2, 0), sigma 1 mm: the priors of the shape alone hold it round.
TYPED_TEST(LowOrder, IsACircleWhereTangentsSayNoMore) {
  std::array<PackedCluster, 128> store{};
  const auto put = [&](double angle, double offset) {
    const Vec2 normal{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    insert(store, place_of(normal, 64), {{normal, static_cast<float>(offset)}, 0.001F}, 1, {});
  };
  for (const double angle : {0.4, 2.5, 4.4}) put(angle, 0.1 + 0.2 * std::cos(angle));
  LowOrderFit<TypeParam::kHybridOrder> fit;
  fit.begin(RadiusPrior{});
  fit.begin_pass(1);
  for (std::size_t i = 0; i < store.size(); ++i) {
    if (store[i].views > 0) fit.add(store, i, true);
  }
  ASSERT_TRUE(solve(fit));
  EXPECT_NEAR(fit.radius(), 0.1F, 5e-4F);
  EXPECT_NEAR(fit.center().x(), 0.2F, 5e-4F);
  EXPECT_NEAR(fit.center().y(), 0.0F, 5e-4F);
  EXPECT_NEAR(fit.at({1, 0}).offset, 0.3F, 1e-3F);
  // A fit begins with twice the sigmas.
  EXPECT_NEAR(fit.at({static_cast<float>(std::cos(0.4)), static_cast<float>(std::sin(0.4))}).sigma, 0.002F, 1e-4F);
}

// Without a tangent the priors are all there is: 0.08 m around the origin, give or take 5 cm and 2 m.
TYPED_TEST(LowOrder, KnowsNothingWithoutTangents) {
  LowOrderFit<TypeParam::kHybridOrder> fit;
  fit.begin(RadiusPrior{});
  fit.begin_pass(1);
  ASSERT_TRUE(solve(fit));
  EXPECT_NEAR(fit.radius(), 0.08F, 1e-6F);
  EXPECT_NEAR(fit.at({1, 0}).sigma, 2.0F, 0.01F);
}

}  // namespace
}  // namespace fencepost::test
