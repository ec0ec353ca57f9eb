#include "host/geometry/planar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/geometry/half_planes.hpp"
#include "host/geometry/rings.hpp"

namespace fencepost::host {
namespace {

Polygon box(double x1, double y1, double x2, double y2) { return {{{x1, y1}, {x2, y1}, {x2, y2}, {x1, y2}}, {}}; }

TEST(Area, TakesHolesOutWhateverTheirOrientation) {
  Polygon ring = box(0, 0, 3, 2);                                  // 6
  ring.holes.push_back({{1, 0.5}, {2, 0.5}, {2, 1.5}, {1, 1.5}});  // 1
  EXPECT_DOUBLE_EQ(area(ring), 5);
  EXPECT_DOUBLE_EQ(area(oriented(ring)), 5);
  EXPECT_DOUBLE_EQ(area(MultiPolygon{ring, box(10, 10, 11, 11)}), 6);
  EXPECT_DOUBLE_EQ(area(MultiPolygon{}), 0);
}

TEST(SetOperations, OfTwoUnitSquaresShiftedByHalf) {
  const MultiPolygon a = {box(0, 0, 1, 1)};
  const MultiPolygon b = {box(0.5, 0.5, 1.5, 1.5)};
  EXPECT_NEAR(intersection_area(a, b), 0.25, 1e-12);
  EXPECT_NEAR(union_area(a, b), 1.75, 1e-12);  // 1 + 1 - 0.25
  EXPECT_NEAR(difference_area(a, b), 0.75, 1e-12);
  ASSERT_EQ(intersection(a, b).size(), 1U);
  EXPECT_GT(signed_area(intersection(a, b)[0].outer), 0);
}

TEST(SetOperations, OfDisjointAndEmptyAreas) {
  const MultiPolygon a = {box(0, 0, 1, 1)};
  const MultiPolygon b = {box(2, 0, 3, 1)};
  EXPECT_TRUE(intersection(a, b).empty());
  EXPECT_EQ(unite(a, b).size(), 2U);
  EXPECT_DOUBLE_EQ(union_area(a, {}), 1);
  EXPECT_DOUBLE_EQ(difference_area({}, a), 0);
  // Sharing an edge is no area.
  EXPECT_DOUBLE_EQ(intersection_area(a, {box(1, 0, 2, 1)}), 0);
}

TEST(SetOperations, PunchAHole) {
  const MultiPolygon result = difference({box(0, 0, 3, 3)}, {box(1, 1, 2, 2)});
  ASSERT_EQ(result.size(), 1U);
  ASSERT_EQ(result[0].holes.size(), 1U);
  EXPECT_GT(signed_area(result[0].outer), 0);
  EXPECT_LT(signed_area(result[0].holes[0]), 0);
  EXPECT_DOUBLE_EQ(area(result), 8);
}

TEST(SetOperations, OverlappingPartsOfOneInputCountOnce) {
  EXPECT_DOUBLE_EQ(union_area({box(0, 0, 2, 1), box(1, 0, 3, 1)}, {}), 3);
}

TEST(Validity, NamesTheCrossing) {
  const Polygon bow_tie = {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}};  // diagonals cross in the middle
  const auto invalid = find_invalidity(bow_tie);
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->reason, "Self-intersection");
  EXPECT_NEAR(invalid->where.x, 0.5, 1e-12);
  EXPECT_NEAR(invalid->where.y, 0.5, 1e-12);
}

TEST(Validity, OfGoodAndDegenerateRings) {
  EXPECT_FALSE(find_invalidity(box(0, 0, 1, 1)).has_value());
  EXPECT_FALSE(find_invalidity(Polygon{{{0, 0}, {0, 1}, {1, 0}}, {}}).has_value()) << "clockwise is valid";
  EXPECT_EQ(find_invalidity(Polygon{{{0, 0}, {1, 0}}, {}})->reason, "Too few points");
  EXPECT_TRUE(find_invalidity(Polygon{{{0, 0}, {1, 0}, {2, 0}}, {}}).has_value());
  Polygon outside = box(0, 0, 1, 1);
  outside.holes.push_back({{5, 5}, {6, 5}, {6, 6}});
  EXPECT_EQ(find_invalidity(outside)->reason, "Hole lies outside shell");
}

TEST(ConvexHull, OfAnL) {
  const Polygon l = {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};  // area 3
  const Polygon hull = convex_hull({l});
  EXPECT_EQ(hull.outer.size(), 5U);
  EXPECT_DOUBLE_EQ(area(hull), 3.5);  // the notch's triangle, 1 * 1 / 2, is filled
  EXPECT_GT(signed_area(hull.outer), 0);
  EXPECT_TRUE(convex_hull({}).outer.empty());
}

TEST(Triangulation, CoversAnLAndASquareWithAHoleButNotTheHole) {
  Polygon ring = box(10, 0, 13, 3);
  ring.holes.push_back({{11, 1}, {11, 2}, {12, 2}, {12, 1}});
  const Polygon l = {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};
  double covered = 0;
  for (const Triangle& triangle : triangulation({l, ring})) {
    const double piece = signed_area(triangle);
    EXPECT_GT(piece, 0) << "counter-clockwise";
    covered += piece;
    const Point middle{(triangle[0].x + triangle[1].x + triangle[2].x) / 3,
                       (triangle[0].y + triangle[1].y + triangle[2].y) / 3};
    EXPECT_TRUE(contains(l, middle) || contains(ring, middle)) << middle.x << " " << middle.y;
  }
  EXPECT_NEAR(covered, 3 + 8, 1e-12);
  EXPECT_TRUE(triangulation({}).empty());
}

TEST(OutlineDistance, OfConcentricSquaresEachWay) {
  const auto distance = outline_distance({box(-0.5, -0.5, 0.5, 0.5)}, {box(-1, -1, 1, 1)});
  ASSERT_TRUE(distance.has_value());
  EXPECT_NEAR(distance->from_a, 0.5, 1e-9);             // side to side
  EXPECT_NEAR(distance->from_b, std::sqrt(0.5), 1e-9);  // corner to corner
  EXPECT_DOUBLE_EQ(distance->hausdorff(), distance->from_b);
  EXPECT_FALSE(outline_distance({}, {box(0, 0, 1, 1)}).has_value());
}

TEST(OutlineDistance, FindsTheMiddleOfALongEdge) {
  // The bottom edge's middle is farthest from a V whose arms meet its ends.
  const Polygon flat = {{{-1, 0}, {1, 0}, {0, 2}}, {}};
  const Polygon notched = {{{-1, 0}, {0, 1}, {1, 0}, {0, 2}}, {}};
  // (0, 0) is sqrt(1/2) from the lines y = 1 - |x|.
  EXPECT_NEAR(outline_distance({flat}, {notched})->from_a, std::sqrt(0.5), 5e-4);
}

TEST(CircleRing, HasTheCirclesAreaAndIsRecognised) {
  const LinearRing ring = circle_ring({3, -2}, 0.05);
  EXPECT_EQ(ring.size(), 256U);
  EXPECT_NEAR(signed_area(ring), std::numbers::pi * 0.0025, 1e-15);
  Point center;
  double radius = 0;
  ASSERT_TRUE(is_circle_ring(ring, center, radius));
  EXPECT_NEAR(center.x, 3, 1e-12);
  EXPECT_NEAR(radius, 0.05, 1e-12);
  LinearRing dented = ring;
  dented[7].x += 1e-6;
  EXPECT_FALSE(is_circle_ring(dented, center, radius));
  EXPECT_FALSE(is_circle_ring(square({0, 0}, 1), center, radius));
}

TEST(Rings, OrientCloseOpenContain) {
  const Polygon clockwise = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}, {}};
  EXPECT_DOUBLE_EQ(signed_area(clockwise.outer), -1);
  EXPECT_DOUBLE_EQ(signed_area(oriented(clockwise).outer), 1);
  EXPECT_EQ(oriented(clockwise).outer.front(), clockwise.outer.front());
  EXPECT_EQ(closed(clockwise.outer).size(), 5U);
  EXPECT_EQ(opened(closed(clockwise.outer)), clockwise.outer);
  Polygon holed = box(0, 0, 3, 3);
  holed.holes.push_back({{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  EXPECT_TRUE(contains(holed, {0.5, 0.5}));
  EXPECT_FALSE(contains(holed, {1.5, 1.5}));
  EXPECT_FALSE(contains(holed, {4, 1.5}));
}

}  // namespace
}  // namespace fencepost::host
