// The scenes and the noise of the tables against their definition.
#include "tests/studies/tables/tour.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/studies/tables/given_run.hpp"
#include "tests/studies/tables/quality_run.hpp"
#include "tests/studies/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

const NoiseLevel& level(std::string_view key) {
  for (const NoiseLevel& candidate : noise_levels()) {
    if (candidate.key == key) return candidate;
  }
  throw std::runtime_error("no such level");
}

struct Counts {
  double seen = 0;
  double hidden_ends = 0;
  double changed = 0;  ///< by more than four sigmas of the edge
  double is_false = 0;
};

// Frame for frame beside the same seed without noise.
Counts count(std::string_view key, double edge_px) {
  Counts counts;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Tour ideal = drive_tour(reference_scene(seed), level("0"));
    const Tour noisy = drive_tour(reference_scene(seed), level(key));
    for (std::size_t v = 0; v < noisy.views.size(); ++v) {
      for (const GivenBlob& given : noisy.views[v].blobs) {
        counts.seen += 1;
        counts.hidden_ends += (given.left_hidden ? 1 : 0) + (given.right_hidden ? 1 : 0);
        counts.is_false += given.is_false ? 1 : 0;
        for (const GivenBlob& before : ideal.views[v].blobs) {
          if (before.object != given.object) continue;
          const int moved =
              std::max(std::abs(before.blob.x1 - given.blob.x1), std::abs(before.blob.x2 - given.blob.x2));
          counts.changed += moved > 4 * edge_px + 1 ? 1 : 0;
        }
      }
    }
  }
  return counts;
}

// The reference's tables count 20 to 21 % of all ends as hidden.
TEST(Tour, HidesAFifthOfAllEnds) {
  const Counts counts = count("0", 0);
  EXPECT_NEAR(counts.hidden_ends / (2 * counts.seen), 0.207, 0.03);
  EXPECT_EQ(counts.changed, 0);
}

// Level S loses 10 %; T loses 20 % and grows 5 % (0.8 * 0.05 + 0.2 = 0.24). Small blobs lose less than is counted.
TEST(Tour, LosesAndGrowsAsOftenAsTheLevelSays) {
  const Counts s = count("S", 1);
  const Counts t = count("T", 1);
  EXPECT_GT(s.changed / s.seen, 0.05);
  EXPECT_LT(s.changed / s.seen, 0.105);
  EXPECT_NEAR(t.changed / s.changed, 2.4, 0.3);
}

TEST(Tour, MissesAndMistakesAsOftenAsTheLevelSays) {
  const Counts ideal = count("0", 0);
  const Counts severe = count("4", 3);
  EXPECT_NEAR(severe.seen / ideal.seen, 0.9, 0.02);  // narrow blobs vanish as well
  EXPECT_NEAR(severe.is_false / severe.seen, 0.05, 0.01);
}

TEST(Tour, IsTheSameForTheSameSeed) {
  const Tour tour = drive_tour(reference_scene(7), level("4"));
  EXPECT_EQ(tour.log, drive_tour(reference_scene(7), level("4")).log);
  EXPECT_NE(tour.log, drive_tour(reference_scene(8), level("4")).log);
  EXPECT_EQ(tour.frames.size(), 75U);
  EXPECT_EQ(tour.views.size(), 75U);
}

// The given flags reach the models: with hidden ends called true, cutting loses what it would have kept.
TEST(GivenRun, CarvesRecklesslyWithWrongFlags) {
  double with_truth = 0;
  double without = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Tour tour = drive_tour(reference_scene(seed), level("0"));
    const auto recklessness = [&] {
      double sum = 0;
      for (const host::ObjectEvaluation& object : run_given(tour, "full").objects) {
        for (const host::ModelScore& model : object.cuts.back().models) {
          if (model.model == "clip_paper") sum += model.score.recklessness;
        }
      }
      return sum / 15;
    };
    with_truth += recklessness();
    for (GivenView& view : tour.views) {
      for (GivenBlob& given : view.blobs) given.left_hidden = given.right_hidden = false;
    }
    without += recklessness();
  }
  EXPECT_LT(with_truth, 0.05);
  EXPECT_GT(without, 0.4);
}

TEST(GivenRun, MeasuresEveryModelAtEveryNumberOfViews) {
  const host::Evaluation evaluation = run_given(drive_tour(reference_scene(3), level("2")), "full");
  ASSERT_EQ(evaluation.objects.size(), 3U);
  for (const host::ObjectEvaluation& object : evaluation.objects) {
    ASSERT_EQ(object.cuts.size(), kTableViews.size() + 1);
    for (const host::Cut& cut : object.cuts) EXPECT_EQ(cut.models.size(), evaluation.models.size());
    EXPECT_EQ(object.cuts.back().views, object.visible);
  }
  EXPECT_THROW(static_cast<void>(run_given(drive_tour(reference_scene(3), level("2")), "huge")), std::runtime_error);
}

}  // namespace
}  // namespace fencepost::test
