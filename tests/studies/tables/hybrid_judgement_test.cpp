#include "tests/studies/tables/hybrid_judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/studies/tables/quality_run.hpp"

namespace fencepost::test {
namespace {

host::ModelScore scored(const std::string& model, double recklessness, double paranoia) {
  return {model, {recklessness, paranoia, 0}};
}

/// One object, seen twice, at the end.
host::Evaluation scene(std::vector<host::ModelScore> models, double confidence = 0) {
  host::Evaluation evaluation;
  host::ObjectEvaluation object;
  object.cuts.push_back({2, true, std::nullopt, std::move(models), confidence});
  evaluation.objects.push_back(object);
  return evaluation;
}

ScenePair pair_of(double hybrid, double carve, double cylinder) {
  return {scene({scored("carve_paper", carve, 0), scored("cylinder_paper", 0, cylinder)}),
          scene({scored("hybrid", 0, hybrid)})};
}

// Differences to carve are -10, -20 and +6: mean -8, standard deviation 13.11, standard error 7.57.
TEST(HybridJudgement, IsPairedWithTheBestModelOfTheCell) {
  const std::vector<ScenePair> scenes{pair_of(0.20, 0.30, 0.90), pair_of(0.20, 0.40, 0.10), pair_of(0.26, 0.20, 0.90)};
  const CellJudgement cell = judge_cell(scenes, {});
  EXPECT_EQ(cell.rival, "carve_paper");  // 30 % on average, the cylinder 63 %
  EXPECT_EQ(cell.objects, 3U);
  EXPECT_NEAR(cell.rival_sum, 30, 1e-9);
  EXPECT_NEAR(cell.sum(), 22, 1e-9);
  EXPECT_NEAR(cell.difference, -8, 1e-9);
  EXPECT_NEAR(cell.standard_error, std::sqrt((4.0 + 144 + 196) / 2 / 3), 1e-9);
  EXPECT_TRUE(cell.holds());
}

TEST(HybridJudgement, OneStandardErrorIsAllowedAndNoMore) {
  const std::vector<ScenePair> close{pair_of(0.30, 0.30, 1), pair_of(0.34, 0.30, 1)};  // +2 +- 2
  EXPECT_TRUE(judge_cell(close, {}).holds());
  const std::vector<ScenePair> worse{pair_of(0.31, 0.30, 1), pair_of(0.34, 0.30, 1)};  // +2.5 +- 1.5
  EXPECT_FALSE(judge_cell(worse, {}).holds());
}

TEST(HybridJudgement, WhatWasMissedHasNoArea) {
  std::vector<ScenePair> scenes{pair_of(0.2, 0.3, 1), pair_of(0.2, 0.3, 1)};
  scenes[1].hybrid.objects[0].cuts[0].models.clear();
  EXPECT_NEAR(judge_cell(scenes, {}).sum(), 110, 1e-9);     // (20 + 200) / 2
  EXPECT_THROW(judge_cell(scenes, 4), std::runtime_error);  // nothing was seen four times
  scenes.pop_back();
  EXPECT_THROW(judge_cell(scenes, {}), std::runtime_error);
}

TEST(HybridJudgement, ConfidenceIsHeldAgainstTheHullOfTheTruth) {
  // An L: its hull has a fifth more area, so P of the hull is 1/6. R = 0.1, P = 0.25: excess 0.1 + 1 - 0.75 * 6 / 5.
  const host::Evaluation one = scene({scored("hybrid", 0.1, 0.25), scored(kHullLimit, 0, 1.0 / 6)}, 0.8);
  const std::vector<Confidence> fits = confidences({&one, 1});
  ASSERT_EQ(fits.size(), 1U);
  EXPECT_NEAR(fits[0].excess, 0.2, 1e-9);
  const std::vector<ConfidenceBin> bins = bins_of(fits);
  ASSERT_EQ(bins.size(), 1U);
  EXPECT_EQ(bins[0].from, 0.75);
  EXPECT_NEAR(bins[0].promised(), 0.21, 1e-9);
}

TEST(HybridJudgement, SpearmanGoesByRank) {
  const std::vector<Confidence> falling{{0.9, 0.01}, {0.5, 0.3}, {0.4, 0.31}, {0.1, 5}};
  EXPECT_NEAR(spearman(falling), 1, 1e-12);
  const std::vector<Confidence> rising{{0.1, 0.1}, {0.2, 0.2}, {0.3, 9}};
  EXPECT_NEAR(spearman(rising), -1, 1e-12);
  // Ranks of doubt 0.5 0.5 2 3 and of excess 0 1 3 2: covariance 3.5, variances 4.5 and 5.
  const std::vector<Confidence> tied{{0.9, 0.1}, {0.9, 0.2}, {0.5, 0.9}, {0.2, 0.4}};
  EXPECT_NEAR(spearman(tied), 3.5 / std::sqrt(4.5 * 5), 1e-12);
}

}  // namespace
}  // namespace fencepost::test
