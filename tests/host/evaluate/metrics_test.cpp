#include "host/evaluate/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/geometry/rings.hpp"
#include "tests/host/evaluate/shapes.hpp"

namespace fencepost::host {
namespace {

using testing::box;
using testing::box_ring;

constexpr double kTiny = 1e-12;

void expect_score(const Score& score, double recklessness, double paranoia, double iou) {
  EXPECT_NEAR(score.recklessness, recklessness, kTiny);
  EXPECT_NEAR(score.paranoia, paranoia, kTiny);
  EXPECT_NEAR(score.iou, iou, kTiny);
}

TEST(Score, OfTheTruthItselfIsPerfect) { expect_score(score({box(1, 2, 0.3, 0.2)}, box(1, 2, 0.3, 0.2)), 0, 0, 1); }

// Footprint 2 x 2 = 4, model 5 x 1 = 5, in common 1 x 1 = 1. R = 1 - 1/4, P = 1 - 1/5, IoU = 1 / (4 + 5 - 1).
TEST(Score, IsSharesOfArea) { expect_score(score({box(1, 1, 5, 1)}, box(0, 0, 2, 2)), 0.75, 0.8, 0.125); }

// A model around the footprint is never reckless, one inside it never paranoid.
TEST(Score, TellsRecklessFromParanoid) {
  expect_score(score({box(0, 0, 4, 2)}, box(0, 0, 2, 2)), 0, 0.5, 0.5);
  expect_score(score({box(0, 0, 1, 2)}, box(0, 0, 2, 2)), 0.5, 0, 0.5);
  expect_score(score({box(5, 5, 1, 1)}, box(0, 0, 2, 2)), 1, 1, 0);
}

void expect_empty(const Score& score) {
  expect_score(score, 1, 1, 0);
  EXPECT_TRUE(score.empty);
}

TEST(Score, AModelWithoutAreaIsEmpty) {
  const Polygon truth = box(0, 0, 2, 2);
  expect_empty(score({}, truth));
  expect_empty(score({Polygon{}}, truth));
  expect_empty(score({Polygon{{{0, 0}, {1, 1}}, {}}}, truth));
  expect_empty(score({Polygon{{{0, 0}, {1, 1}, {2, 2}}, {}}}, truth));
  expect_empty(score({box(1, 1, 1e-5, 1e-5)}, truth));  // 1e-10 m^2
  EXPECT_FALSE(score({box(5, 5, 1, 1)}, truth).empty) << "beside the footprint, but a shape";
  EXPECT_FALSE(score({truth}, box(0, 0, 1e-5, 1e-5)).empty) << "the footprint has no area, not the model";
}

TEST(Score, ACoordinateThatIsNoNumberIsAnEmptyModel) {
  Polygon broken = box(0, 0, 2, 2);
  broken.outer[2].x = std::numeric_limits<double>::quiet_NaN();
  expect_empty(score({broken}, box(0, 0, 2, 2)));
  Polygon far = box(0, 0, 2, 2);
  far.holes = {{{0.1, 0.1}, {0.1, HUGE_VAL}, {0.2, 0.1}}};
  expect_empty(score({far}, box(0, 0, 2, 2)));
}

// Model 4 x 4 with a hole of 2 x 2 in which the footprint lies: nothing in common. A ring twice counts once.
TEST(Score, RespectsHolesAndOverlaps) {
  Polygon ring = box(0, 0, 4, 4);
  ring.holes = {box_ring(1, 1, 2, 2)};
  expect_score(score({ring}, box(1, 1, 2, 2)), 1, 1, 0);
  // Footprint with a hole: 16 - 4 = 12; the full model of 16 encloses it and 4 of free space.
  expect_score(score({box(0, 0, 4, 4)}, ring), 0, 0.25, 0.75);
  expect_score(score({box(0, 0, 4, 2), box(0, 0, 4, 2)}, box(0, 0, 2, 2)), 0, 0.5, 0.5);
}

// Two squares that touch in a point, written as one ring that crosses itself there: area 2 x 0.25 of the footprint's 1.
TEST(Score, RepairsARingThatCrossesItself) {
  const Polygon bow_tie{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}};
  expect_score(score({bow_tie}, box(0, 0, 1, 1)), 0.5, 0, 0.5);
}

TEST(Score, DoesNotDependOnOrientationOrPlace) {
  Polygon model = box(0.05, 0.02, 0.2, 0.1);
  const Polygon truth = box(0, 0, 0.15, 0.15);
  const Score here = score({model}, truth);
  const Score there = score({moved(model, 0.7, {12, -3})}, moved(truth, 0.7, {12, -3}));
  std::swap(model.outer[0], model.outer[2]);  // now clockwise
  expect_score(score({model}, truth), here.recklessness, here.paranoia, here.iou);
  EXPECT_NEAR(there.recklessness, here.recklessness, 1e-9);
  EXPECT_NEAR(there.paranoia, here.paranoia, 1e-9);
}

TEST(Centroid, OfABoxIsItsMiddle) {
  const Point c = centroid(box(10, 20, 4, 2));
  EXPECT_NEAR(c.x, 12, kTiny);
  EXPECT_NEAR(c.y, 21, kTiny);
  EXPECT_NEAR(circumscribed_radius(box(10, 20, 4, 2)), std::sqrt(5), kTiny);
}

// An L of a 2 x 1 foot (middle (1, 0.5)) and a 1 x 1 top (middle (0.5, 1.5)). x = (2 * 1 + 1 * 0.5) / 3 = 5/6,
// y = (2 * 0.5 + 1 * 1.5) / 3 = 5/6.
TEST(Centroid, OfAnL) {
  const Polygon l{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};
  EXPECT_NEAR(centroid(l).x, 5.0 / 6, kTiny);
  EXPECT_NEAR(centroid(l).y, 5.0 / 6, kTiny);
}

// 4 x 4 (middle 2) without 2 x 2 at the left (middle 1): x = (16 * 2 - 4 * 1) / 12 = 7/3. The hole's orientation is
// no matter.
TEST(Centroid, LeavesHolesOut) {
  Polygon ring = box(0, 0, 4, 4);
  ring.holes = {box_ring(0, 1, 2, 2)};
  EXPECT_NEAR(centroid(ring).x, 7.0 / 3, kTiny);
  std::swap(ring.holes[0][1], ring.holes[0][3]);
  EXPECT_NEAR(centroid(ring).x, 7.0 / 3, kTiny);
  EXPECT_NEAR(centroid(ring).y, 2, kTiny);
}

TEST(Centroid, OfNothingIsAVertex) {
  EXPECT_EQ(centroid({}), (Point{0, 0}));
  EXPECT_EQ(centroid(Polygon{{{3, 4}, {5, 6}}, {}}), (Point{3, 4}));
}

}  // namespace
}  // namespace fencepost::host
