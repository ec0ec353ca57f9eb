#include "host/metrics/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/simulate/random.hpp"

namespace fencepost::host {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr FieldOfView kWide{-10, 10, -10, 10};
/// At the origin, looking along x, 15 cm above the floor.
constexpr CameraPose kLens{0, 0, 0.15, 0};

SceneObject block(double x1, double y1, double x2, double y2, double height = 0.3) {
  return {"block", 1, 0, height, {{{x1, y1}, {x2, y1}, {x2, y2}, {x1, y2}}, {}}};
}

/// A square of 0.2 m, its near face 1 m ahead.
SceneObject square_ahead(double height = 0.3) { return block(1, -0.1, 1.2, 0.1, height); }

double share(const std::vector<SceneObject>& objects, const CameraPose& lens = kLens, const FieldOfView& view = kWide) {
  return visible_perimeter(objects, 0, lens, view).share();
}

TEST(VisiblePerimeter, IsAQuarterOfASquareSeenFromOneSide) { EXPECT_NEAR(share({square_ahead()}), 0.25, 1e-12); }

TEST(VisiblePerimeter, IsHalfOfASquareSeenFromACorner) {
  EXPECT_NEAR(share({square_ahead()}, {2, 1, 0.15, -3 * kPi / 4}), 0.5, 1e-12);
}

TEST(VisiblePerimeter, IsCutByAnObjectInFront) {
  // Half way, so it throws a shadow of twice its width: from y = 0 to 0.1 of the face from -0.1 to 0.1.
  EXPECT_NEAR(share({square_ahead(), block(0.5, 0, 0.52, 0.05)}), 0.125, 1e-12);
}

TEST(VisiblePerimeter, IsNotCutByAnObjectBehind) {
  EXPECT_NEAR(share({square_ahead(), block(1.5, -1, 1.6, 1)}), 0.25, 1e-12);
}

TEST(VisiblePerimeter, IsNothingBehindAWall) { EXPECT_EQ(share({square_ahead(), block(0.5, -1, 0.6, 1)}), 0); }

TEST(VisiblePerimeter, IsSeenAboveALowObject) {
  // The low block's far upper edge falls 0.05 / 0.6 a metre below the lens; the square's top rises 0.05 / 1.
  EXPECT_NEAR(share({square_ahead(0.2), block(0.5, -1, 0.6, 1, 0.1)}), 0.25, 1e-12);
  // A top 0.09 below the lens at 1 m, lower than 0.05 / 0.6 = 0.0833: hidden. At 0.08 it is not.
  EXPECT_EQ(share({square_ahead(0.06), block(0.5, -1, 0.6, 1, 0.1)}), 0);
  EXPECT_NEAR(share({square_ahead(0.07), block(0.5, -1, 0.6, 1, 0.1)}), 0.25, 1e-12);
}

TEST(VisiblePerimeter, IsSeenBelowAHangingObject) {
  SceneObject lamp = block(0.5, -1, 0.6, 1, 0.2);
  lamp.base = 0.2;
  EXPECT_NEAR(share({square_ahead(), lamp}), 0.25, 1e-12);
}

TEST(VisiblePerimeter, EndsWithTheFieldOfView) {
  // Columns up to slope 0.05: of the face y = -0.1..0.1, the part y > -0.05 (across is -y / x).
  EXPECT_NEAR(share({square_ahead()}, kLens, {-10, 0.05, -10, 10}), 0.25 * 0.75, 1e-12);
  // The image ends above the square's top at 1 m, which rises 0.15; below its foot, which falls 0.15.
  EXPECT_EQ(share({square_ahead()}, kLens, {-10, 10, 0.16, 10}), 0);
  EXPECT_NEAR(share({square_ahead()}, kLens, {-10, 10, 0.14, 10}), 0.25, 1e-12);
  EXPECT_EQ(share({square_ahead()}, kLens, {-10, 10, -10, -0.16}), 0);
}

TEST(VisiblePerimeter, IsNothingBehindTheLens) { EXPECT_EQ(share({square_ahead()}, {0, 0, 0.15, kPi}), 0); }

TEST(VisiblePerimeter, OfACircleGrowsWithDistance) {
  // Tangents touch at acos(r / d) from the axis: 2 acos(r / d) of 2 pi. A 4096-gon has edges of 1 / 4096.
  for (const double distance : {0.15, 0.3, 1.0, 5.0}) {
    const SceneObject circle{"circle", 1, 0, 0.3, {circle_ring({distance, 0}, 0.1, 4096), {}}};
    EXPECT_NEAR(share({circle}), std::acos(0.1 / distance) / kPi, 2.0 / 4096) << distance;
  }
}

TEST(VisiblePerimeter, OfAnLIsHiddenByItsOwnArm) {
  // Seen along -y: the arm's end (0.1) and the notch's floor (0.1) face the lens. Moved to the left, the arm hides part
  // of the floor and its side wall turns into view.
  const SceneObject ell{"L", 1, 0, 0.3, {{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0}, {0, 0}, {0, 0.1}, {-0.1, 0.1}}, {}}};
  const double perimeter = 0.8;
  // From (0.05, 1): straight above the notch. The arm's side x = 0 faces right: seen too, but not its back.
  EXPECT_NEAR(share({ell}, {0.05, 1, 0.15, -kPi / 2}), (0.1 + 0.1 + 0.1) / perimeter, 1e-12);
  // From (-0.05, 1.1) the ray past the arm's corner (0, 0.1) goes 0.05 right for 1 down. It meets y = 0 at x = 0.005:
  // 0.095 of the floor stays in view, and of the arm its end.
  EXPECT_NEAR(share({ell}, {-0.05, 1.1, 0.15, -kPi / 2}), (0.1 + 0.095) / perimeter, 1e-12);
}

TEST(VisiblePerimeter, TurnsAndMovesWithTheWorld) {
  const std::vector<SceneObject> objects{square_ahead(), block(0.5, -0.03, 0.55, 0.02)};
  const double here = share(objects);
  std::vector<SceneObject> moved_objects = objects;
  for (SceneObject& object : moved_objects) object.footprint = moved(object.footprint, 2, {3, -4});
  EXPECT_GT(here, 0.1);
  EXPECT_NEAR(share(moved_objects, {3, -4, 0.15, 2}), here, 1e-9);
}

/// True if nothing of `objects` lies on the way from the lens to `p`.
bool in_sight(const std::vector<SceneObject>& objects, Point p) {
  for (const SceneObject& object : objects) {
    const LinearRing& ring = object.footprint.outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point e{ring[(i + 1) % ring.size()].x - a.x, ring[(i + 1) % ring.size()].y - a.y};
      const double det = p.x * e.y - p.y * e.x;
      if (std::abs(det) < 1e-12) continue;
      const double along_ray = (a.x * e.y - a.y * e.x) / det;
      const double along_edge = (a.x * p.y - a.y * p.x) / det;
      if (along_ray > 1e-9 && along_ray < 1 - 1e-9 && along_edge > 0 && along_edge < 1) return false;
    }
  }
  return true;
}

double sampled_share(const std::vector<SceneObject>& objects, const FieldOfView& view) {
  constexpr int kSamples = 2000;
  const LinearRing& ring = objects[0].footprint.outer;
  double seen = 0;
  double all = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    all += length;
    for (int k = 0; k < kSamples; ++k) {
      const double t = (k + 0.5) / kSamples;
      const Point p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      const double across = -p.y / p.x;
      if (p.x <= 0 || across < view.across_min || across > view.across_max) continue;
      if (in_sight(objects, p)) seen += length / kSamples;
    }
  }
  return seen / all;
}

TEST(VisiblePerimeter, AgreesWithRaysToManyPoints) {
  int partly = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed, Purpose::kDetection, 0);
    std::vector<SceneObject> objects;
    for (int i = 0; i < 4; ++i) {  // one in each quarter of the square ahead, so that they do not overlap
      const Point place{1 + 0.3 * (i / 2) + random.uniform(-0.04, 0.04), -0.15 + 0.3 * (i % 2)};
      const double a = random.uniform(0.05, 0.1);
      const double b = random.uniform(0.03, 0.1);
      const LinearRing ell{{-a, -a}, {a, -a}, {a, -a + b}, {-a + b, -a + b}, {-a + b, a}, {-a, a}};
      objects.push_back({"o", 1, 0, 1, moved({ell, {}}, random.uniform(0, 2 * kPi), place)});
    }
    std::swap(objects[0], objects[random.below(4)]);
    const FieldOfView view{-random.uniform(0.05, 0.3), random.uniform(0.05, 0.3), -10, 10};
    const double exact = share(objects, kLens, view);
    EXPECT_NEAR(exact, sampled_share(objects, view), 2e-3) << "seed " << seed;
    if (exact > 0.02 && exact < 0.45) ++partly;
  }
  EXPECT_GT(partly, 30);
}

TEST(FieldOfView, ReachesTheOuterEdgesOfTheOutermostPixels) {
  sensor::CameraIntrinsics camera;
  camera.width = 100;
  camera.height = 50;
  camera.fx = camera.fy = base::Pixels2::nearest(100);
  camera.cx = base::Pixels2::nearest(49.5);
  camera.cy = base::Pixels2::nearest(24.5);
  const FieldOfView level = field_of_view(camera, 0);
  EXPECT_NEAR(level.across_min, -0.5, 1e-12);
  EXPECT_NEAR(level.across_max, 0.5, 1e-12);
  EXPECT_NEAR(level.rise_min, -0.25, 1e-12);
  EXPECT_NEAR(level.rise_max, 0.25, 1e-12);
  // Looking 45 degrees down, the middle column's lowest ray is atan(0.25) lower still.
  EXPECT_NEAR(field_of_view(camera, kPi / 4).rise_min, -std::tan(kPi / 4 + std::atan(0.25)), 1e-12);
}

}  // namespace
}  // namespace fencepost::host
