#include "host/geometry/planar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/geometry/half_planes.hpp"
#include "host/geometry/rings.hpp"
#include "tests/host/geometry/geos_session.hpp"

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

TEST(Overlap, OfTwoUnitSquaresShiftedByHalf) {
  const MultiPolygon a = {box(0, 0, 1, 1)};
  const MultiPolygon b = {box(0.5, 0.5, 1.5, 1.5)};
  EXPECT_NEAR(intersection_area(a, b), 0.25, 1e-12);
  EXPECT_NEAR(union_area(a, b), 1.75, 1e-12);  // 1 + 1 - 0.25
  EXPECT_NEAR(difference_area(a, b), 0.75, 1e-12);
}

TEST(Overlap, OfDisjointAndEmptyAreas) {
  const MultiPolygon a = {box(0, 0, 1, 1)};
  const MultiPolygon b = {box(2, 0, 3, 1)};
  EXPECT_DOUBLE_EQ(intersection_area(a, b), 0);
  EXPECT_DOUBLE_EQ(union_area(a, b), 2);
  EXPECT_DOUBLE_EQ(union_area(a, {}), 1);
  EXPECT_DOUBLE_EQ(difference_area({}, a), 0);
  // Sharing an edge is no area.
  EXPECT_DOUBLE_EQ(intersection_area(a, {box(1, 0, 2, 1)}), 0);
}

TEST(Overlap, LeavesAHoleOut) {
  Polygon ring = box(0, 0, 3, 3);
  ring.holes.push_back({{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  EXPECT_DOUBLE_EQ(difference_area({box(0, 0, 3, 3)}, {ring}), 1);
  EXPECT_DOUBLE_EQ(intersection_area({box(1, 1, 2, 2)}, {ring}), 0);
}

/// A star about `center`, its corners in order, with up to one smaller star as a hole; crossed if `wild`.
Polygon random_polygon(std::mt19937& random, bool wild) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto ring = [&](Point middle, double least, double most, std::size_t corners) {
    LinearRing corner_ring;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + 0.8 * uniform(random)) / double(corners);
      const double radius = least + (most - least) * uniform(random);
      corner_ring.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
    }
    if (wild) std::ranges::shuffle(corner_ring, random);
    return corner_ring;
  };
  const Point center{uniform(random), uniform(random)};
  Polygon polygon{ring(center, 0.3, 1, 5 + random() % 20), {}};
  if (random() % 2 == 0) polygon.holes.push_back(ring(center, 0.05, wild ? 0.5 : 0.08, 3 + random() % 8));
  return polygon;
}

TEST(Overlap, AgreesWithGeosOnRandomPolygonsThatMayCrossThemselves) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    const bool wild = trial % 2 == 0;
    const MultiPolygon a = {random_polygon(random, wild), random_polygon(random, false)};
    const MultiPolygon b = {random_polygon(random, wild)};
    const Overlap found = overlap(a, b);
    GeosSession geos;
    EXPECT_NEAR(found.both, area(geos.intersection(a, b)), 1e-12) << trial;
    EXPECT_NEAR(found.both + found.only_a, geos.union_area(a, {}), 1e-12) << trial;
    EXPECT_NEAR(found.both + found.only_b, geos.union_area(b, {}), 1e-12) << trial;
  }
}

TEST(Overlap, OverlappingPartsOfOneInputCountOnce) {
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

TEST(Validity, OfHolesThatTouch) {
  Polygon holed = box(0, 0, 4, 4);
  holed.holes.push_back({{0, 2}, {1, 1}, {1, 3}});  // in one point: fine
  EXPECT_FALSE(find_invalidity(holed).has_value());
  holed.holes.push_back({{4, 2}, {1, 1}, {3, 1}});  // from there to the other side
  EXPECT_EQ(find_invalidity(holed)->reason, "Interior is disconnected");
  Polygon nested = box(0, 0, 4, 4);
  nested.holes = {{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, {{1.5, 1.5}, {2, 1.5}, {2, 2}}};
  EXPECT_EQ(find_invalidity(nested)->reason, "Holes are nested");
  EXPECT_EQ(find_invalidity(Polygon{{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}, {}})->reason,
            "Ring Self-intersection");
}

TEST(Validity, AgreesWithGeosOnRandomPolygons) {
  std::mt19937 random(12);
  int valid = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    // On a grid corners meet sides and each other.
    Polygon polygon = random_polygon(random, trial % 4 == 0);
    if (trial % 2 == 0) {
      const auto snap = [](LinearRing& ring) {
        for (Point& p : ring) p = {std::round(6 * p.x), std::round(6 * p.y)};
      };
      snap(polygon.outer);
      for (LinearRing& hole : polygon.holes) snap(hole);
    }
    const auto invalid = find_invalidity(polygon);
    EXPECT_EQ(!invalid, GeosSession().is_valid(polygon)) << trial << " " << (invalid ? invalid->reason : "");
    valid += invalid ? 0 : 1;
  }
  EXPECT_GT(valid, kTrials / 4);
  EXPECT_LT(valid, kTrials * 3 / 4);
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

TEST(Triangulation, CoversRandomPolygonsAndNothingElse) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 300; ++trial) {
    Polygon polygon = random_polygon(random, false);
    if (trial % 3 == 0) polygon = box(-1, -1, 2, 2);
    // Holes beside each other, some of them at one height.
    if (trial % 3 == 0) {
      for (int i = 0; i < 4; ++i) {
        const double x = -0.8 + 0.6 * i;
        const double y = trial % 2 == 0 ? 0 : 0.1 * i;
        polygon.holes.push_back({{x, y}, {x + 0.3, y}, {x + 0.3, y + 0.4}, {x + 0.1, y + 0.2}});
      }
    }
    if (find_invalidity(polygon)) continue;
    MultiPolygon pieces;
    double covered = 0;
    for (const Triangle& t : triangulation({polygon})) {
      pieces.push_back({{t.begin(), t.end()}, {}});
      covered += signed_area(t);
    }
    EXPECT_NEAR(covered, area(polygon), 1e-12) << trial;
    EXPECT_NEAR(difference_area(pieces, {polygon}), 0, 1e-12) << trial;
  }
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
