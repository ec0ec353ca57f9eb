#include "host/evaluate/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace fencepost::host {
namespace {

using Costs = std::vector<std::vector<double>>;
using Pairs = std::vector<std::optional<std::size_t>>;
constexpr double kNever = kNeverPaired;

TEST(Assignment, OfNothingIsNothing) {
  EXPECT_EQ(pair_cheapest({}, 1), Pairs{});
  EXPECT_EQ(pair_cheapest({{}, {}}, 1), (Pairs{std::nullopt, std::nullopt}));
}

// Greedy would pair row 0 with column 0 (0.1) and leave 0.9 for row 1: 1.0. The whole is cheaper crossed: 0.2 + 0.2.
TEST(Assignment, LooksAtTheWhole) { EXPECT_EQ(pair_cheapest({{0.1, 0.2}, {0.2, 0.9}}, 1), (Pairs{1, 0})); }

// Both pairs together would cost 0.9 + 0.9, the first row alone with its neighbour 0.1 + 1.
TEST(Assignment, LeavesARowAloneWhereThatIsCheaper) {
  EXPECT_EQ(pair_cheapest({{0.1, 0.9}, {0.9, kNever}}, 1), (Pairs{0, std::nullopt}));
}

TEST(Assignment, NeverMakesAPairThatCannotBe) {
  EXPECT_EQ(pair_cheapest({{kNever, kNever}, {kNever, 0.5}}, 1), (Pairs{std::nullopt, 1}));
  EXPECT_EQ(pair_cheapest({{0.5}, {0.4}, {0.6}}, 1), (Pairs{std::nullopt, 0, std::nullopt}));
}

double price(const Costs& costs, const Pairs& pairs, double alone) {
  double sum = 0;
  for (std::size_t i = 0; i < costs.size(); ++i) sum += pairs[i] ? costs[i][*pairs[i]] : alone;
  return sum;
}

double cheapest_by_trying(const Costs& costs, std::size_t row, std::vector<bool>& taken, double alone) {
  if (row == costs.size()) return 0;
  double best = alone + cheapest_by_trying(costs, row + 1, taken, alone);
  for (std::size_t c = 0; c < taken.size(); ++c) {
    if (taken[c]) continue;
    taken[c] = true;
    best = std::min(best, costs[row][c] + cheapest_by_trying(costs, row + 1, taken, alone));
    taken[c] = false;
  }
  return best;
}

TEST(Assignment, IsAsCheapAsTryingEverything) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1.4);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t rows = random() % 6;
    const std::size_t columns = random() % 6;
    Costs costs(rows, std::vector<double>(columns));
    for (auto& row : costs) {
      for (double& cost : row) {
        cost = share(random);
        if (cost > 1) cost = kNever;
      }
    }
    const Pairs pairs = pair_cheapest(costs, 1);
    ASSERT_EQ(pairs.size(), rows);
    std::vector<bool> used(columns);
    for (const auto& column : pairs) {
      if (!column) continue;
      EXPECT_FALSE(used[*column]);
      used[*column] = true;
    }
    std::vector<bool> taken(columns);
    EXPECT_NEAR(price(costs, pairs, 1), cheapest_by_trying(costs, 0, taken, 1), 1e-12);
  }
}

}  // namespace
}  // namespace fencepost::host
