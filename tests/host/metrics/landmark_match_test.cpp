#include "host/metrics/landmark_match.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

Region red(double left) { return {left, 50, left + 40, 70, 800, 1, Colour{200, 40, 40}}; }
Region blue(double left) { return {left, 50, left + 40, 70, 800, 2, Colour{40, 70, 190}}; }

double error(const Region& real, const Region& rendered) {
  return reacquisition_error(reacquisition_terms(real, rendered, 320));
}

TEST(MatchLandmark, TakesTheNearestRegion) {
  const std::vector<Region> regions{blue(80), red(90), red(200)};
  const LandmarkMatch match = match_landmark(red(80), regions, 320);
  EXPECT_EQ(match.region, 1U);
  EXPECT_DOUBLE_EQ(match.error, error(regions[1], red(80)));
}

TEST(MatchLandmark, IsAsSureAsTheSecondBestIsWorse) {
  // 10 px and 20 px off, of 30: 0.7 / 3 and 1.4 / 3 in location, weighted 0.25 / 1.11.
  const std::vector<Region> regions{red(100), red(90)};
  const LandmarkMatch match = match_landmark(red(80), regions, 320);
  EXPECT_EQ(match.region, 1U);
  EXPECT_NEAR(match.match_confidence, 0.7 / 3 * 0.25 / 1.11, 1e-12);
  // The order of the regions does not matter.
  const std::vector<Region> turned{red(90), red(100)};
  EXPECT_EQ(match_landmark(red(80), turned, 320).match_confidence, match.match_confidence);
}

TEST(MatchLandmark, ComparesWithCertainErrorWhereThereIsNoSecond) {
  const std::vector<Region> one{red(80)};
  EXPECT_EQ(match_landmark(red(80), one, 320).match_confidence, 1);
}

TEST(MatchLandmark, HasAMarginToRefusalToo) {
  // Alone, 15 px off of 30: an error of 0.35 * 0.25 / 1.11, and refusal is at 0.30.
  const std::vector<Region> one{red(95)};
  EXPECT_NEAR(match_landmark(red(80), one, 320).margin, 0.30 - 0.35 * 0.25 / 1.11, 1e-12);
  // With a second one that is nearer than refusal, the second one counts.
  const std::vector<Region> two{red(95), red(80)};
  const LandmarkMatch match = match_landmark(red(80), two, 320);
  EXPECT_NEAR(match.margin, 0.35 * 0.25 / 1.11, 1e-12);
  EXPECT_NEAR(match.match_confidence, match.margin, 1e-12);
  const std::vector<Region> other{blue(80)};
  EXPECT_EQ(match_landmark(red(80), other, 320).margin, 0);
}

TEST(MatchLandmark, AcceptsOnlyBelowTheThreshold) {
  const std::vector<Region> other{blue(80)};
  const LandmarkMatch match = match_landmark(red(80), other, 320);
  EXPECT_GT(match.error, kAcceptedError);
  EXPECT_FALSE(match.region.has_value());
  EXPECT_EQ(match.best, 0U);
}

TEST(MatchLandmark, FindsNothingAmongNoRegions) {
  const LandmarkMatch match = match_landmark(red(80), {}, 320);
  EXPECT_FALSE(match.region.has_value());
  EXPECT_EQ(match.error, 1);
  EXPECT_EQ(match.match_confidence, 0);
}

TEST(OutcomeOf, HasTheSixOfFigureNine) {
  LandmarkMatch accepted;
  accepted.region = 0;
  const LandmarkMatch refused;
  EXPECT_EQ(outcome_of(accepted, {true, true}), MatchOutcome::kMatched);
  EXPECT_EQ(outcome_of(refused, {false, false}), MatchOutcome::kUnmatched);
  EXPECT_EQ(outcome_of(std::nullopt, {false, false}), MatchOutcome::kUnseen);
  EXPECT_EQ(outcome_of(accepted, {true, false}), MatchOutcome::kMismatched);
  EXPECT_EQ(outcome_of(accepted, {false, false}), MatchOutcome::kMismatched);
  EXPECT_EQ(outcome_of(refused, {true, false}), MatchOutcome::kMissed);
  EXPECT_EQ(outcome_of(std::nullopt, {true, false}), MatchOutcome::kUnrendered);
  // A sliver at the border that is found after all is no error.
  EXPECT_EQ(outcome_of(accepted, {false, true}), MatchOutcome::kMatched);
}

TEST(MatchOutcome, HalfAreCorrectAndEachHasItsRow) {
  using enum MatchOutcome;
  for (const MatchOutcome outcome : {kMatched, kUnmatched, kUnseen}) {
    EXPECT_TRUE(is_correct(outcome));
    EXPECT_EQ(result_type(outcome), outcome);
  }
  for (const MatchOutcome outcome : {kMismatched, kMissed, kUnrendered}) EXPECT_FALSE(is_correct(outcome));
  EXPECT_EQ(result_type(kMismatched), kMatched);
  EXPECT_EQ(result_type(kMissed), kUnmatched);
  EXPECT_EQ(result_type(kUnrendered), kUnseen);
}

TEST(OutcomeCounts, GiveThePapersAccuracies) {
  // The paper's red landmark by space carving: 4 of 59 matched wrong, 2 of 8 unmatched, 0 of 6 unseen: 91.78 % of 73.
  OutcomeCounts counts;
  counts.counts = {55, 6, 6, 4, 2, 0};
  EXPECT_EQ(counts.total(MatchOutcome::kMatched), 59U);
  EXPECT_EQ(counts.incorrect(MatchOutcome::kUnmatched), 2U);
  EXPECT_NEAR(100 * counts.accuracy(MatchOutcome::kMatched), 93.22, 0.005);
  EXPECT_NEAR(100 * counts.accuracy(MatchOutcome::kUnmatched), 75.00, 0.005);
  EXPECT_EQ(counts.accuracy(MatchOutcome::kUnseen), 1);
  EXPECT_NEAR(100 * counts.accuracy(), 91.78, 0.005);
  OutcomeCounts sum = counts;
  sum.add(counts);
  EXPECT_EQ(sum.total(), 146U);
  EXPECT_EQ(sum.incorrect(), 12U);
  EXPECT_EQ(OutcomeCounts{}.accuracy(), 1);
}

}  // namespace
}  // namespace fencepost::host
