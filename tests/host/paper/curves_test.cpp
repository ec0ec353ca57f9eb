#include <gtest/gtest.h>

#include <cmath>

#include "host/paper/figure.hpp"
#include "host/paper/figure_curves.hpp"

namespace fencepost::host {
namespace {

TEST(BinnedMeans, AreOfThePointsInEachPart) {
  const std::vector<Point> points{{0, 1}, {0.1, 3}, {0.49, 5}, {0.5, 10}, {1, 20}, {1.1, 99}, {-0.1, 99}};
  const std::vector<Point> means = binned_means(points, 0, 1, 2);
  ASSERT_EQ(means.size(), 2U);
  EXPECT_NEAR(means[0].x, 0.59 / 3, 1e-12);
  EXPECT_NEAR(means[0].y, 3, 1e-12);
  EXPECT_NEAR(means[1].x, 0.75, 1e-12);
  EXPECT_NEAR(means[1].y, 15, 1e-12);
  EXPECT_EQ(binned_means(points, 0, 1, 2, 3).size(), 1U);  // the second part has two points only
  EXPECT_TRUE(binned_means({}, 0, 1, 5).empty());
}

TEST(Slope, IsTheLeastSquaresLines) {
  EXPECT_NEAR(slope({{0, 1}, {1, 3}, {2, 5}})->value, 2, 1e-12);
  EXPECT_NEAR(slope({{0, 1}, {1, 3}, {2, 5}})->sigma, 0, 1e-7);
  // Means (1, 2): sums of dx dy = 1*1 + 1*1 = 2, of dx^2 = 2.
  EXPECT_NEAR(slope({{0, 1}, {1, 2}, {2, 3}})->value, 1, 1e-12);
  EXPECT_NEAR(slope({{0, 0}, {1, 3}, {2, 0}})->value, 0, 1e-12);
  // Residuals 1, -2, 1 of one degree of freedom, over a sum of squares of 2.
  EXPECT_NEAR(slope({{0, 0}, {1, 3}, {2, 0}})->sigma, std::sqrt(3.0), 1e-9);
  EXPECT_FALSE(slope({{1, 1}, {1, 2}}));
  EXPECT_FALSE(slope({{1, 1}}));
  EXPECT_FALSE(slope({}));
}

// Shares that are computed in different orders differ in the last bit: a spread of nothing, which once gave a slope of
// 16861948652493.99.
TEST(Slope, RoundingIsNoSpread) {
  const double same = 0.1 + 0.2;
  ASSERT_NE(same, 0.3);
  EXPECT_FALSE(slope({{same, 0.2}, {0.3, 0.9}, {0.3, 0.4}}));
  EXPECT_NEAR(slope({{0.3, 0.4}, {0.30001, 0.5}, {0.30002, 0.6}})->value, 1e4, 1) << "a small spread is one";
}

PaperData novelties(const std::vector<std::vector<NoveltySample>>& samples) {
  PaperData data;
  data.novelty = samples;
  data.noisy.resize(1);
  return data;
}

TEST(Figure13, SaysWhereThereIsNothingToFit) {
  const std::vector<NoveltySample> one_place = {{8, 0.1 + 0.2, 0.2}, {8, 0.3, 0.9}};
  const PaperFigure none = figure_13(novelties(std::vector(algorithms().size(), one_place)));
  EXPECT_NE(none.html.find("nothing to fit"), std::string::npos);
  ASSERT_EQ(none.claims.size(), 2U);
  EXPECT_EQ(none.claims[0].kind, ClaimKind::kDiffers);
  EXPECT_NE(none.claims[0].text.find("nothing to fit"), std::string::npos) << none.claims[0].text;

  const std::vector<NoveltySample> falling = {{8, 0.1, 0.9}, {8, 0.25, 0.72}, {8, 0.4, 0.5}, {8, 0.7, 0.5}};
  const PaperFigure some = figure_13(novelties(std::vector(algorithms().size(), falling)));
  EXPECT_NE(some.claims[0].text.find("in 3 of 3 segments"), std::string::npos)
      << "above half new there is a single viewpoint: " << some.claims[0].text;
}

TEST(RankCorrelation, SeesOrderOnly) {
  EXPECT_NEAR(rank_correlation({{0, 0}, {1, 1}, {2, 100}}), 1, 1e-12);
  EXPECT_NEAR(rank_correlation({{0, 5}, {1, 4}, {2, -100}}), -1, 1e-12);
  // Ranks 1 2 3 4 against 2 1 4 3: 1 - 6 * 4 / (4 * 15).
  EXPECT_NEAR(rank_correlation({{1, 20}, {2, 10}, {3, 40}, {4, 30}}), 0.6, 1e-12);
  // Ties share ranks: 1 2.5 2.5 4 against 1 2 3 4. Sums of products 4.5, of squares 4.5 and 5.
  EXPECT_NEAR(rank_correlation({{1, 1}, {2, 2}, {2, 3}, {3, 4}}), 4.5 / std::sqrt(4.5 * 5), 1e-12);
  EXPECT_EQ(rank_correlation({{1, 1}}), 0);
}

TEST(Csv, QuotesWhatWouldBreakARow) {
  Csv csv("a,b");
  csv.row({"plain", "with, comma"});
  csv.row({"with \"quotes\"", ""});
  EXPECT_EQ(csv.text(), "a,b\nplain,\"with, comma\"\n\"with \"\"quotes\"\"\",\n");
}

TEST(CsvNumber, IsEmptyWhereThereIsNone) {
  EXPECT_EQ(csv_number(0.12345), "0.1235");
  EXPECT_EQ(csv_number(-0.00001), "0.0000");
  EXPECT_EQ(csv_number(99.5, 2), "99.50");
  EXPECT_EQ(csv_number(std::nan("")), "");
}

TEST(PaperFigure, SaysWhetherAClaimHolds) {
  PaperFigure figure{"1", "t", {}, {}, {}};
  figure.say("one", true, "So it is.", " A reason.");
  figure.say("other", false, "So it is.", " A reason.");
  ASSERT_EQ(figure.claims.size(), 2U);
  EXPECT_EQ(figure.claims[0].kind, ClaimKind::kMatches);
  EXPECT_EQ(figure.claims[0].text, "So it is.");
  EXPECT_EQ(figure.claims[1].kind, ClaimKind::kDiffers);
  EXPECT_EQ(figure.claims[1].text, "Not here: So it is. A reason.");
}

}  // namespace
}  // namespace fencepost::host
