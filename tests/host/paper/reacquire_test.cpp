#include "host/paper/reacquire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/paper/blocks_world.hpp"
#include "tests/host/paper/worlds.hpp"

namespace fencepost::host {
namespace {

using enum MatchOutcome;

/// The truth, as a perfect reconstruction would have it.
std::vector<Solid> true_blocks(const Scene& scene) { return {solid_of(scene, 0), solid_of(scene, 1)}; }

std::vector<Reacquisition> reacquire(const Tour& tour, const std::vector<Solid>& world, std::size_t frame) {
  RegionRenderer renderer(tour.scene.camera);
  return reacquire_both(tour, renderer, world, frame);
}

TEST(ReacquireBoth, FindsTrueBlocksWithHardlyAnyError) {
  const Tour tour = drive(testing::two_squares());
  for (const Reacquisition& one : reacquire(tour, true_blocks(tour.scene), 0)) {
    EXPECT_EQ(one.outcome, kMatched);
    EXPECT_LT(one.match->error, 0.1);  // the colours' noise is all
    EXPECT_GT(one.match->match_confidence, 0.3);
  }
}

TEST(ReacquireBoth, SeesThatALandmarkIsBesideTheImage) {
  const Tour tour = drive(testing::two_squares());
  const auto both = reacquire(tour, true_blocks(tour.scene), 2);
  EXPECT_EQ(both[kRedLandmark].outcome, kMatched);
  EXPECT_FALSE(both[kYellowLandmark].rendered.has_value());
  EXPECT_EQ(both[kYellowLandmark].outcome, kUnseen);
}

TEST(ReacquireBoth, SaysWhatAWrongWorldGetsWrong) {
  const Tour tour = drive(testing::two_squares());
  std::vector<Solid> world = true_blocks(tour.scene);
  world[kRedLandmark].footprint.clear();  // carved away
  EXPECT_EQ(reacquire(tour, world, 0)[kRedLandmark].outcome, kUnrendered);

  world = true_blocks(tour.scene);
  world[kRedLandmark].colour = {40, 70, 190};  // another colour: nothing is near enough
  EXPECT_EQ(reacquire(tour, world, 0)[kRedLandmark].outcome, kMissed);

  world = true_blocks(tour.scene);
  std::swap(world[kRedLandmark], world[kYellowLandmark]);  // red is taken for yellow, and yellow for red
  for (const Reacquisition& one : reacquire(tour, world, 0)) EXPECT_EQ(one.outcome, kMismatched);

  world = true_blocks(tour.scene);
  // Rendered in the third image, where the real one is not.
  world[kYellowLandmark].footprint = {{{{1, 0.0}, {1.1, 0.0}, {1.1, 0.1}, {1, 0.1}}, {}}};
  EXPECT_EQ(reacquire(tour, world, 2)[kYellowLandmark].outcome, kUnmatched);
}

TEST(ReacquisitionScore, CountsByLandmarkAndKeepsConfidences) {
  const Tour tour = drive(testing::two_squares());
  RegionRenderer renderer(tour.scene.camera);
  ReacquisitionScore score;
  score.add(reacquire_all(tour, renderer, true_blocks(tour.scene)));
  EXPECT_EQ(score.landmarks[kRedLandmark].of(kMatched), 3U);
  EXPECT_EQ(score.landmarks[kYellowLandmark].of(kMatched), 2U);
  EXPECT_EQ(score.landmarks[kYellowLandmark].of(kUnseen), 1U);
  EXPECT_EQ(score.right_confidences.size(), 5U);
  EXPECT_TRUE(score.wrong_confidences.empty());
  EXPECT_EQ(score.all().accuracy(), 1);
  std::vector<Solid> wrong = true_blocks(tour.scene);
  wrong[kRedLandmark].footprint.clear();
  score.add(reacquire_all(tour, renderer, wrong));
  EXPECT_EQ(score.landmarks[kRedLandmark].of(kUnrendered), 3U);
  EXPECT_EQ(score.all().accuracy(), 0.75);  // 9 of 12
  EXPECT_EQ(score.scene_accuracies, (std::vector<double>{1, 0.5}));
  score.count_empty(wrong);
  EXPECT_EQ(score.empty, (std::vector<std::size_t>{1, 0}));
}

TEST(AreaUnderCurve, IsTheShareOfPairsInOrder) {
  EXPECT_EQ(area_under_curve({0.5, 0.6}, {0.1, 0.2}), 1);
  EXPECT_EQ(area_under_curve({0.1, 0.2}, {0.5, 0.6}), 0);
  // Of six pairs 0.3 > {0.1, 0.2}, 0.3 = 0.3 and 0.15 > 0.1: 3.5.
  EXPECT_NEAR(area_under_curve({0.3, 0.15}, {0.1, 0.2, 0.3}), 3.5 / 6, 1e-12);
  EXPECT_EQ(area_under_curve({0.5}, {}), 1);
}

TEST(StandardError, IsOfTheMean) {
  // Mean 3, deviations -2, 0, 2: variance 8 / 2, over 3.
  EXPECT_NEAR(standard_error({1, 3, 5}), std::sqrt(4.0 / 3), 1e-12);
  EXPECT_EQ(standard_error({1}), 0);
  EXPECT_EQ(mean({1, 2, 6}), 3);
  EXPECT_EQ(mean({}), 0);
}

}  // namespace
}  // namespace fencepost::host
