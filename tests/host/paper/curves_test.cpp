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
  EXPECT_NEAR(slope({{0, 1}, {1, 3}, {2, 5}}), 2, 1e-12);
  // Means (1, 2): sums of dx dy = 1*1 + 1*1 = 2, of dx^2 = 2.
  EXPECT_NEAR(slope({{0, 1}, {1, 2}, {2, 3}}), 1, 1e-12);
  EXPECT_NEAR(slope({{0, 0}, {1, 3}, {2, 0}}), 0, 1e-12);
  EXPECT_EQ(slope({{1, 1}, {1, 2}}), 0);
  EXPECT_EQ(slope({}), 0);
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
  figure.say(true, "So it is.", " A reason.");
  figure.say(false, "So it is.", " A reason.");
  ASSERT_EQ(figure.claims.size(), 2U);
  EXPECT_EQ(figure.claims[0].kind, ClaimKind::kMatches);
  EXPECT_EQ(figure.claims[0].text, "So it is.");
  EXPECT_EQ(figure.claims[1].kind, ClaimKind::kDiffers);
  EXPECT_EQ(figure.claims[1].text, "Not here: So it is. A reason.");
}

}  // namespace
}  // namespace fencepost::host
