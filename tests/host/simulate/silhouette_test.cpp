// The columns of a solid against each ray by itself.
#include "host/simulate/silhouette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "host/geometry/rings.hpp"

namespace fencepost::host {
namespace {

sensor::CameraIntrinsics level_camera() {
  sensor::CameraIntrinsics camera;
  camera.width = 120;
  camera.height = 90;
  camera.fx = camera.fy = base::Pixels2::nearest(100);
  camera.cx = base::Pixels2::nearest(59.5);
  camera.cy = base::Pixels2::nearest(44.5);
  return camera;
}

SceneObject random_object(std::mt19937& random) {
  const auto uniform = [&](double a, double b) { return a + (b - a) * (static_cast<double>(random()) / 4294967295.0); };
  SceneObject object;
  object.base = uniform(0, 1) < 0.4 ? uniform(0, 0.4) : 0;
  object.height_m = uniform(0.02, 0.4);
  const double size = uniform(0.03, 0.3);
  const auto kind = random() % 4;
  if (kind == 0) object.footprint.outer = circle_ring({0, 0}, size, 256);
  if (kind == 1) object.footprint.outer = {{-size, -size / 2}, {size, -size}, {size / 2, size}};
  if (kind == 2)
    object.footprint.outer = {{0, 0}, {2 * size, 0}, {2 * size, size}, {size, size}, {size, 2 * size}, {0, 2 * size}};
  if (kind == 3) {
    object.footprint.outer = circle_ring({0, 0}, size, 12);
    object.footprint.holes.push_back(circle_ring({0, 0}, size / 2, 5));
  }
  object.footprint = moved(object.footprint, uniform(0, 6), {uniform(-0.2, 2), uniform(-0.8, 0.8)});
  return object;
}

std::optional<double> hit_of(const Prism& prism, const std::vector<Stretch>& stretches, double rise) {
  for (const Stretch& stretch : stretches) {
    const double hit = prism.first_hit(stretch, rise);
    if (hit >= 0) return hit;
  }
  return std::nullopt;
}

TEST(Silhouette, IsWhatEachRayMeets) {
  const PixelRays rays(level_camera(), 0);
  std::mt19937 random(7);
  Silhouette silhouette;
  int whole = 0;
  int other = 0;
  int pixels = 0;
  for (int round = 0; round < 600; ++round) {
    const SceneObject object = random_object(random);
    const Prism prism(object, {0, 0, 0.05 + 0.1 * (round % 5), 0});
    silhouette.find(prism, rays);
    std::vector<Stretch> stretches;
    PixelBox box;
    for (int u = 0; u < rays.width(); ++u) {
      stretches.clear();
      if (!prism.behind()) prism.stretches(rays.across(u, 0), stretches);
      std::optional<double> nearest;
      for (int v = 0; v < rays.height(); ++v) {
        const std::optional<double> hit = hit_of(prism, stretches, rays.rise(0, v));
        if (hit) {
          ASSERT_TRUE(silhouette.bounds().contains(u, v)) << round;
          box.include(u, v);
          nearest = nearest ? std::min(*nearest, *hit) : *hit;
          ++pixels;
        }
        if (silhouette.whole()) {
          ASSERT_EQ(silhouette.covers(u, v), hit.has_value()) << round << ": " << u << ", " << v;
        }
      }
      if (silhouette.whole() && nearest) {
        const auto column = static_cast<std::size_t>(u - silhouette.box().x1);
        ASSERT_EQ(silhouette.columns()[column].nearest, *nearest) << round << ": " << u;
      }
      if (!silhouette.bounds().empty() && u >= silhouette.bounds().x1 && u <= silhouette.bounds().x2) {
        const auto met = silhouette.stretches(u);
        ASSERT_EQ(met.size(), stretches.size());
        for (std::size_t i = 0; i < met.size(); ++i) {
          ASSERT_EQ(met[i].enter, stretches[i].enter);
          ASSERT_EQ(met[i].leave, stretches[i].leave);
        }
      }
    }
    if (silhouette.whole() && !box.empty()) {
      ++whole;
      ASSERT_EQ(silhouette.box().x1, box.x1);
      ASSERT_EQ(silhouette.box().x2, box.x2);
      ASSERT_EQ(silhouette.box().y1, box.y1);
      ASSERT_EQ(silhouette.box().y2, box.y2);
    }
    other += silhouette.whole() ? 0 : 1;
  }
  EXPECT_GT(whole, 200);
  EXPECT_GT(other, 50);
  EXPECT_GT(pixels, 100'000);
}

}  // namespace
}  // namespace fencepost::host
