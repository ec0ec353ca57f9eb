// Alg. 1 as printed: bearings of interval centres that cross, radius from the half angle.
#include "host/models/cylinder_paper.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

constexpr recon::MapPoint kOrigin{0, 0};

recon::CylinderPaper paper_of(const std::vector<recon::Sighting>& sightings) {
  recon::CylinderPaper paper;
  for (const recon::Sighting& sighting : sightings) paper.add(sighting, kOrigin);
  return paper;
}

recon::Sighting circle_from(host::Point lens) { return view_of_circle({1.0, 0.5}, 0.1, lens).sighting; }

void expect_circle(const recon::PaperCylinder& cylinder, double x, double y, double radius, double within = 2e-6) {
  ASSERT_TRUE(cylinder.ok);
  EXPECT_NEAR(static_cast<double>(cylinder.center.x()), x, within);
  EXPECT_NEAR(static_cast<double>(cylinder.center.y()), y, within);
  EXPECT_NEAR(static_cast<double>(cylinder.radius), radius, within);
}

// Each centre bearing of a circle runs through its centre, and d sin(half angle) is its radius.
TEST(CylinderPaper, TwoBearingsGiveACircleExactly) {
  expect_circle(paper_of({circle_from({0, 0}), circle_from({1, -0.5})}).solve(), 1.0, 0.5, 0.1);
}

// Bearings along x = 0, along y = 0 and along y = 0.3 (all counting the same): x is 0, y the mean of 0 and 0.3.
// Half angles with sine 0.1 at distances 1, 1 and 2: (0.115 + 0.1 + 0.2) / 3, where the first is 1 + 0.15 away.
TEST(CylinderPaper, IsTheLeastSquaresPointAndTheMeanRadius) {
  const double half = std::asin(0.1);
  const double quarter = std::numbers::pi / 2;
  const auto view = [&](host::Point lens, double bearing) {
    return view_between(lens, bearing - half, bearing + half).sighting;
  };
  expect_circle(paper_of({view({0, -1}, quarter), view({-1, 0}, 0), view({-2, 0.3}, 0)}).solve(), 0, 0.15,
                (0.115 + 0.1 + 0.2) / 3);
}

TEST(CylinderPaper, ViewsWithACensoredEndDoNotCount) {
  recon::Sighting cut = view_between({0, 1}, -0.2, 0.3).sighting;
  cut.left.end = recon::End::kLowerBound;
  expect_circle(paper_of({circle_from({0, 0}), cut, circle_from({1, -0.5})}).solve(), 1.0, 0.5, 0.1);
  EXPECT_EQ(paper_of({cut}).views(), 0.0F);
}

TEST(CylinderPaper, OneBearingOrParallelOnesSayNothing) {
  EXPECT_FALSE(paper_of({}).solve().ok);
  EXPECT_FALSE(paper_of({circle_from({0, 0})}).solve().ok);
  EXPECT_FALSE(paper_of({circle_from({0, 0}), circle_from({0, 0})}).solve().ok);
  const auto ahead = [](double y) { return view_between({0, y}, -0.1, 0.1).sighting; };
  EXPECT_FALSE(paper_of({ahead(0), ahead(0.2)}).solve().ok);
}

// Bearings that part ahead of the lenses cross behind them: no object is there.
TEST(CylinderPaper, ACrossingBehindTheLensesIsRefused) {
  EXPECT_FALSE(
      paper_of({view_between({0, 0.2}, 0.2, 0.4).sighting, view_between({0, -0.2}, -0.4, -0.2).sighting}).solve().ok);
}

TEST(CylinderPaper, MovesWithTheOrigin) {
  recon::CylinderPaper paper = paper_of({circle_from({0, 0}), circle_from({1, -0.5}), circle_from({0, 1})});
  paper.move_origin({0.4F, -0.3F});
  expect_circle(paper.solve(), 0.6, 0.8, 0.1);
}

}  // namespace
}  // namespace fencepost::test
