// The renderer against a slow, independent one: every pixel's ray in three dimensions against every face.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "host/geometry/rings.hpp"
#include "host/simulate/optics.hpp"
#include "host/simulate/render.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

struct Vector {
  double x, y, z;
};

/// Bisection on the lens equation; the renderer uses Newton.
double slow_undistort(double distorted, double k1) {
  double low = 0;
  double high = k1 < 0 ? std::sqrt(-1 / (3 * k1)) : distorted + 1;
  if (high * (1 + k1 * high * high) < distorted) return -1;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (middle * (1 + k1 * middle * middle) < distorted ? low : high) = middle;
  }
  return low;
}

/// Nearest crossing of the ray with any side, lid or floor of the prism; infinity when there is none.
double slow_hit(const SceneObject& object, const Vector& from, const Vector& along) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto& ring = object.footprint.outer;
  const double top = object.base + object.height_m;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    const double ex = b.x - a.x;
    const double ey = b.y - a.y;
    const double det = along.x * ey - along.y * ex;
    if (det == 0) continue;
    const double s = ((a.x - from.x) * ey - (a.y - from.y) * ex) / det;
    const double share = ((a.x - from.x) * along.y - (a.y - from.y) * along.x) / det;
    const double z = from.z + s * along.z;
    if (s > 0 && share >= 0 && share <= 1 && z >= object.base && z <= top) nearest = std::min(nearest, s);
  }
  for (const double z : {object.base, top}) {
    if (along.z == 0) continue;
    const double s = (z - from.z) / along.z;
    if (s > 0 && contains(object.footprint, {from.x + s * along.x, from.y + s * along.y})) {
      nearest = std::min(nearest, s);
    }
  }
  return nearest;
}

std::vector<SceneObject> random_objects(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<SceneObject> objects;
  for (int i = 0; i < 5; ++i) {
    SceneObject object;
    object.base = uniform(random) < 0.3 ? 0.15 * uniform(random) : 0;
    object.height_m = 0.05 + 0.25 * uniform(random);
    const double size = 0.05 + 0.1 * uniform(random);
    if (i == 0) {
      object.footprint.outer = circle_ring({0, 0}, size, 64);
    } else if (i == 1) {  // an L: not convex
      object.footprint.outer = {{0, 0}, {2 * size, 0}, {2 * size, size}, {size, size}, {size, 2 * size}, {0, 2 * size}};
    } else {
      object.footprint.outer = {{-size, -size / 2}, {size, -size}, {size / 2, size}};
    }
    const Point place{0.6 + 0.25 * i + 0.1 * uniform(random), 0.8 * (uniform(random) - 0.5)};
    object.footprint = moved(object.footprint, 6.28 * uniform(random), place);
    objects.push_back(object);
  }
  return objects;
}

struct Case {
  double pitch;
  double k1;
};

class Oracle : public testing::TestWithParam<Case> {};

TEST_P(Oracle, AgreesOnEveryPixel) {
  const auto [pitch, k1] = GetParam();
  Scene scene = empty_scene();
  scene.camera.width = 158;  // a quarter of the pixels: the slow one takes its time
  scene.camera.height = 104;
  scene.camera.fx = base::Pixels2::nearest(136.83);
  scene.camera.fy = base::Pixels2::nearest(141.17);
  scene.camera.cx = base::Pixels2::nearest(77.31);
  scene.camera.cy = base::Pixels2::nearest(50.77);
  scene.camera.k1 = base::Ratio4::nearest(k1);
  const PixelRays rays(scene.camera, pitch);
  LabelImage image(scene.camera.width, scene.camera.height);
  std::mt19937 random(11);
  int covered = 0;
  int different = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const auto objects = random_objects(random);
    const CameraPose pose{0.013, 0.027, 0.17, 0.1 * trial - 0.2};
    image.render(objects, rays, pose);
    for (int v = 0; v < image.height(); ++v) {
      for (int u = 0; u < image.width(); ++u) {
        const double xd = (u - 77.31) / 136.83;
        const double yd = (v - 50.77) / 141.17;
        const double rd = std::hypot(xd, yd);
        const double ru = slow_undistort(rd, k1);
        int expected = -1;
        if (ru >= 0) {
          const double x = xd * ru / rd;
          const double y = yd * ru / rd;
          // Camera axes: ahead tilted down by pitch, left, up.
          const double ahead = std::cos(pitch) - y * std::sin(pitch);
          const double up = -std::sin(pitch) - y * std::cos(pitch);
          const double c = std::cos(pose.heading);
          const double s = std::sin(pose.heading);
          const Vector along{ahead * c + x * s, ahead * s - x * c, up};
          double nearest = std::numeric_limits<double>::infinity();
          for (std::size_t i = 0; i < objects.size(); ++i) {
            const double hit = slow_hit(objects[i], {pose.x, pose.y, pose.z}, along);
            if (hit < nearest) {
              nearest = hit;
              expected = static_cast<int>(i);
            }
          }
        }
        covered += expected >= 0 ? 1 : 0;
        different += image.at(u, v) == expected ? 0 : 1;
      }
    }
  }
  EXPECT_GT(covered, 3000) << "the scenes are empty: nothing was compared";
  EXPECT_EQ(different, 0);
}

INSTANTIATE_TEST_SUITE_P(Lenses, Oracle,
                         testing::Values(Case{0, 0}, Case{0.2, 0}, Case{-0.15, 0}, Case{0, -0.2}, Case{0, 0.1},
                                         Case{0.3, -0.25}, Case{0, -0.6}));

TEST(Optics, UndistortionInvertsTheLens) {
  for (const double k1 : {-0.3, -0.05, 0.0, 0.2}) {
    for (double r = 0; r < 0.9; r += 0.05) {
      EXPECT_NEAR(undistorted_radius(r * (1 + k1 * r * r), k1), r, 1e-12) << k1 << " " << r;
    }
  }
  EXPECT_LT(undistorted_radius(2, -0.3), 0) << "beyond the fold there is no ray";
}

}  // namespace
}  // namespace fencepost::host
