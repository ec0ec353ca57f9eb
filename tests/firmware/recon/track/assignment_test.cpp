#include "firmware/recon/track/assignment.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "firmware/recon/track/tuning.hpp"

namespace fencepost::test {
namespace {

using recon::kImpossible;
using recon::kNoMatch;
using recon::kUnmatchedCost;

struct Problem {
  std::size_t objects;
  std::size_t blobs;
  std::vector<std::uint8_t> costs;  // [object][blob]
};

std::vector<std::uint8_t> solve(const Problem& problem) {
  std::vector<std::uint8_t> object_of(problem.blobs);
  std::vector<recon::AssignmentColumn> scratch(problem.objects + problem.blobs + 1);
  recon::assign(problem.costs, problem.objects, object_of, scratch);
  return object_of;
}

int cost_of(const Problem& problem, const std::vector<std::uint8_t>& object_of) {
  int sum = 0;
  for (std::size_t b = 0; b < problem.blobs; ++b) {
    sum += object_of[b] == kNoMatch ? kUnmatchedCost : problem.costs[object_of[b] * problem.blobs + b];
  }
  return sum;
}

// Every possibility, for the oracle.
int best_cost(const Problem& problem, std::size_t blob, std::vector<bool>& used) {
  if (blob == problem.blobs) return 0;
  int best = kUnmatchedCost + best_cost(problem, blob + 1, used);
  for (std::size_t o = 0; o < problem.objects; ++o) {
    const std::uint8_t cost = problem.costs[o * problem.blobs + blob];
    if (used[o] || cost == kImpossible) continue;
    used[o] = true;
    best = std::min(best, cost + best_cost(problem, blob + 1, used));
    used[o] = false;
  }
  return best;
}

TEST(Assignment, TheWholeCountsNotTheCheapestPair) {
  // Blob 0 suits object 0 best (10), but then blob 1 would have to stay alone: 20 + 30 beats 10 + 160.
  const Problem problem{2, 2, {10, 30, 20, kImpossible}};
  EXPECT_EQ(solve(problem), (std::vector<std::uint8_t>{1, 0}));
}

TEST(Assignment, ImpossiblePairsStayApart) {
  const Problem problem{1, 2, {kImpossible, kImpossible}};
  EXPECT_EQ(solve(problem), (std::vector<std::uint8_t>{kNoMatch, kNoMatch}));
}

TEST(Assignment, NoBlobsOrNoObjects) {
  EXPECT_TRUE(solve({3, 0, {}}).empty());
  EXPECT_EQ(solve({0, 2, {}}), (std::vector<std::uint8_t>{kNoMatch, kNoMatch}));
}

TEST(Assignment, IsOptimalOnRandomProblems) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    Problem problem{random() % 6, random() % 6, {}};
    for (std::size_t i = 0; i < problem.objects * problem.blobs; ++i) {
      problem.costs.push_back(random() % 3 == 0 ? kImpossible : static_cast<std::uint8_t>(random() % 201));
    }
    const auto object_of = solve(problem);
    std::vector<bool> taken(problem.objects, false);
    for (std::size_t b = 0; b < problem.blobs; ++b) {
      if (object_of[b] == kNoMatch) continue;
      ASSERT_FALSE(taken[object_of[b]]);
      taken[object_of[b]] = true;
      ASSERT_NE(problem.costs[object_of[b] * problem.blobs + b], kImpossible);
    }
    std::vector<bool> used(problem.objects, false);
    ASSERT_EQ(cost_of(problem, object_of), best_cost(problem, 0, used)) << round;
  }
}

TEST(Assignment, TheLargestProblemFits) {
  Problem problem{32, 16, std::vector<std::uint8_t>(32 * 16)};
  std::mt19937 random(6);
  for (std::uint8_t& cost : problem.costs) cost = static_cast<std::uint8_t>(1 + random() % 200);
  for (std::size_t b = 0; b < 16; ++b) problem.costs[(31 - b) * 16 + b] = 0;
  const auto object_of = solve(problem);
  for (std::size_t b = 0; b < 16; ++b) EXPECT_EQ(object_of[b], 31 - b);
}

}  // namespace
}  // namespace fencepost::test
