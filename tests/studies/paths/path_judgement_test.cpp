#include "tests/studies/paths/path_judgement.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace fencepost::test {
namespace {

ObjectScores object(double recklessness, double paranoia) { return {{"hybrid", {recklessness, paranoia, 0}}}; }

// Sums 30, 50; 70. Mean 50. By scenes: off by -20 and 20, so sqrt((400 + 400) 2 / 1) / 3 = 40 / 3.
TEST(PathJudgement, MeansAreOverObjectsAndErrorsOverScenes) {
  const std::vector<SceneScores> scenes{{object(0.1, 0.2), object(0.2, 0.3)}, {object(0.3, 0.4)}};
  const PathMean mean = mean_of(scenes, "hybrid");
  EXPECT_NEAR(mean.recklessness, 20, 1e-9);
  EXPECT_NEAR(mean.paranoia, 30, 1e-9);
  EXPECT_NEAR(mean.standard_error, 40.0 / 3, 1e-9);
}

TEST(PathJudgement, AModelThatIsMissingHasNoArea) {
  const std::vector<SceneScores> scenes{{object(0, 0)}, {ObjectScores{}}};
  EXPECT_NEAR(mean_of(scenes, "hybrid").sum(), 100, 1e-9);
}

TEST(PathJudgement, ScenesWithoutObjectsAreNoScenes) {
  EXPECT_THROW(mean_of(std::vector<SceneScores>{{object(0, 0)}, {}}, "hybrid"), std::runtime_error);
  EXPECT_NEAR(mean_of(std::vector<SceneScores>{{object(0, 0.1)}, {}, {object(0, 0.3)}}, "hybrid").sum(), 20, 1e-9);
}

// sqrt(3^2 + 4^2) = 5.
TEST(PathJudgement, MayBeWorseByOneErrorOfBothSamples) {
  const PathReference reference{Path::kTour, false, 0, 0, 0, 0, 40, 4};
  EXPECT_TRUE(reaches({20, 24.9, 3}, reference));
  EXPECT_FALSE(reaches({20, 25.1, 3}, reference));
}

TEST(PathJudgement, HasAFigureForEveryPath) {
  for (const PathText& path : kPaths) {
    for (const bool drift : {false, true}) {
      int found = 0;
      for (const PathReference& reference : kPathReferences) {
        found += reference.path == path.path && reference.drift == drift ? 1 : 0;
      }
      EXPECT_EQ(found, 1) << path.name;
    }
  }
}

}  // namespace
}  // namespace fencepost::test
