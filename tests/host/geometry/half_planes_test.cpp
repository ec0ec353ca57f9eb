#include "host/geometry/half_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "tests/host/geometry/geos_session.hpp"

namespace fencepost::host {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(HalfPlanes, CutASquare) {
  const LinearRing start = square({0, 0}, 2);                       // 4
  EXPECT_DOUBLE_EQ(signed_area(clipped(start, {{1, 0}, 0.5})), 3);  // x <= 0.5: 1.5 * 2
  EXPECT_DOUBLE_EQ(signed_area(clipped(start, {{1, 1}, 0})), 2);    // the diagonal
  EXPECT_TRUE(clipped(start, {{1, 0}, -1.5}).empty());
  EXPECT_EQ(clipped(start, {{1, 0}, 1}), start) << "touching cuts nothing";
}

TEST(Wedges, TwoAtRightAnglesMakeASquareDiamond) {
  // From (-1, 0) looking along +x and from (0, -1) along +y, half opening atan(0.5):
  // |y| <= (x + 1) / 2 and |x| <= (y + 1) / 2. The lines y = (x+1)/2 and x = (y+1)/2 meet in the corner (1, 1).
  // y = -(x+1)/2 and x = -(y+1)/2 meet in (-1/3, -1/3).
  // y = (x+1)/2 and x = -(y+1)/2 meet in (-3/5, 1/5), and by symmetry there is its mirror (1/5, -3/5).
  const double half = std::atan(0.5);
  const std::vector<Wedge> wedges = {{{-1, 0}, -half, half}, {{0, -1}, kPi / 2 - half, kPi / 2 + half}};
  const LinearRing region = intersect_wedges(square({0, 0}, 4), wedges);
  ASSERT_EQ(region.size(), 4U);
  // Shoelace of (1,1), (-3/5,1/5), (-1/3,-1/3), (1/5,-3/5):
  // (1/5+3/5) + (1/5+1/15) + (1/5+1/15) + (1/5+3/5) = 8/5 + 8/15 = 32/15, half of it 16/15.
  EXPECT_NEAR(signed_area(region), 16.0 / 15.0, 1e-12);
}

TEST(Wedges, AgreeWithGeosOnRandomViews) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Wedge> wedges;
    MultiPolygon expected = {{square({0, 0}, 4), {}}};
    for (int view = 0; view < 5; ++view) {
      const double at = kPi * uniform(random);
      const Point apex{1.5 * std::cos(at), 1.5 * std::sin(at)};
      const double towards = at + kPi + 0.05 * uniform(random);
      const Wedge wedge{apex, towards - 0.2, towards + 0.15};
      wedges.push_back(wedge);
      // The wedge as a long triangle.
      const Polygon triangle = {{apex,
                                 {apex.x + 20 * std::cos(wedge.right), apex.y + 20 * std::sin(wedge.right)},
                                 {apex.x + 20 * std::cos(wedge.left), apex.y + 20 * std::sin(wedge.left)}},
                                {}};
      expected = GeosSession().intersection(expected, {triangle});
    }
    const LinearRing region = intersect_wedges(square({0, 0}, 4), wedges);
    EXPECT_NEAR(signed_area(region), area(expected), 1e-9);
    EXPECT_NEAR(intersection_area({{region, {}}}, expected), area(expected), 1e-9);
  }
}

TEST(Wedges, NothingBehindTheCameraSurvives) {
  const std::vector<Wedge> wedges = {{{0, 0}, -0.1, 0.1}};
  for (const Point p : intersect_wedges(square({0, 0}, 4), wedges)) EXPECT_GE(p.x, -1e-12);
}

}  // namespace
}  // namespace fencepost::host
