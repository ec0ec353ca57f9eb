#include "firmware/recon/observe/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/recon/observe/sighting.hpp"

namespace fencepost::test {
namespace {

using base::Metres;
using base::Pixels2;
using base::Radians;

// 100 x 80 px, f = 100 px, principal point in the middle of the pixel grid.
sensor::CameraIntrinsics simple_camera() {
  sensor::CameraIntrinsics camera;
  camera.width = 100;
  camera.height = 80;
  camera.fx = camera.fy = Pixels2::nearest(100);
  camera.cx = Pixels2::nearest(49.5);
  camera.cy = Pixels2::nearest(39.5);
  camera.mount.z = Metres::nearest(0.1);
  camera.mount.pitch = Radians{0};
  return camera;
}

// At the origin, looking along x: map axes are the level camera's.
recon::Sighting seen_by(const recon::CameraModel& camera, const recon::Box& box) {
  return recon::make_sighting(camera, {}, recon::observe_alone(camera, box));
}

void expect_direction(const recon::Vec2& direction, double forward, double left) {
  const double length = std::hypot(forward, left);
  EXPECT_NEAR(static_cast<double>(direction.x()), forward / length, 1e-6);
  EXPECT_NEAR(static_cast<double>(direction.y()), left / length, 1e-6);
}

TEST(CameraModel, EdgesLieHalfAPixelOutsideTheBox) {
  const auto camera = recon::make_camera_model(simple_camera());
  // x1 = 30: edge 29.5, (29.5 - 49.5) / 100 = -0.2 right, that is 0.2 left. x2 = 59: edge 59.5, 0.1 right.
  // y2 = 59: edge 59.5, (59.5 - 39.5) / 100 = 0.2 down per metre.
  const auto rays = seen_by(camera, {30, 20, 59, 59});
  expect_direction(rays.left.direction, 1, 0.2);
  expect_direction(rays.right.direction, 1, -0.1);
  expect_direction(rays.center, 1, 0.05);  // middle column 44.5
  EXPECT_NEAR(rays.bottom.drop, 0.2, 1e-6);
  EXPECT_NEAR(rays.top.drop, -0.2, 1e-6);  // edge 19.5
}

TEST(CameraModel, EndsOnTheBorderAreLowerBounds) {
  const auto camera = recon::make_camera_model(simple_camera());
  struct Case {
    recon::Box box;
    bool left, right, top, bottom;
  };
  const Case cases[] = {{{2, 2, 97, 77}, false, false, false, false}, {{1, 2, 97, 77}, true, false, false, false},
                        {{0, 2, 97, 77}, true, false, false, false},  {{2, 2, 98, 77}, false, true, false, false},
                        {{2, 2, 99, 77}, false, true, false, false},  {{2, 1, 97, 77}, false, false, true, false},
                        {{2, 2, 97, 78}, false, false, false, true}};
  const auto end = [](bool cut) { return cut ? recon::End::kLowerBound : recon::End::kSeen; };
  for (const Case& c : cases) {
    const auto rays = seen_by(camera, c.box);
    EXPECT_EQ(rays.left.end, end(c.left)) << c.box.x1;
    EXPECT_EQ(rays.right.end, end(c.right)) << c.box.x2;
    EXPECT_EQ(rays.top.end, end(c.top)) << c.box.y1;
    EXPECT_EQ(rays.bottom.end, end(c.bottom)) << c.box.y2;
  }
}

TEST(CameraModel, DistortionIsInverted) {
  for (const double k1 : {-0.2, -0.05, 0.1, 0.3}) {
    sensor::CameraIntrinsics intrinsics = simple_camera();
    intrinsics.k1 = base::Ratio4::nearest(k1);
    const auto camera = recon::make_camera_model(intrinsics);
    for (double x = -0.5; x <= 0.5; x += 0.125) {
      for (double y = -0.4; y <= 0.4; y += 0.1) {
        const double factor = 1 + k1 * (x * x + y * y);
        const auto undistorted = recon::undistort(camera, static_cast<float>(49.5 + 100 * x * factor),
                                                  static_cast<float>(39.5 + 100 * y * factor));
        EXPECT_NEAR(static_cast<double>(undistorted.x()), x, 2e-6) << k1;
        EXPECT_NEAR(static_cast<double>(undistorted.y()), y, 2e-6) << k1;
      }
    }
  }
}

TEST(CameraModel, PitchTiltsRowsAndSpreadsColumns) {
  sensor::CameraIntrinsics intrinsics = simple_camera();
  intrinsics.mount.pitch = Radians::nearest(0.05);
  const auto camera = recon::make_camera_model(intrinsics);
  // A point 2 m ahead, 0.3 m left, on the floor 0.1 m below the lens, seen by a camera that looks 0.05 rad down:
  // along the axis 2 cos p + 0.1 sin p, below it 0.1 cos p - 2 sin p.
  const double p = 0.05;
  const double depth = 2 * std::cos(p) + 0.1 * std::sin(p);
  const double x = -0.3 / depth;
  const double y = (0.1 * std::cos(p) - 2 * std::sin(p)) / depth;
  const auto u = static_cast<float>(49.5 + 100 * x);
  const auto v = static_cast<float>(39.5 + 100 * y);
  const recon::Vec2 normalised = recon::undistort(camera, u, v);
  // One box whose left edge and middle row are that point, and whose bottom edge is its row.
  recon::Box box{static_cast<std::int16_t>(std::lround(u + 0.5F)), 0, 60, 0};
  EXPECT_NEAR(static_cast<double>(normalised.x()), x, 1e-6);
  const double forward = std::cos(p) - y * std::sin(p);
  EXPECT_NEAR(std::atan2(-x, forward), std::atan2(0.3, 2), 1e-9);  // the formula of the model, checked in double
  box.y1 = box.y2 = static_cast<std::int16_t>(std::lround(v));
  const auto rays = seen_by(camera, box);
  const double row = (box.y2 + 0.5 - 39.5) / 100;
  const double drop = (std::sin(p) + row * std::cos(p)) / (std::cos(p) - row * std::sin(p));
  EXPECT_NEAR(static_cast<double>(rays.bottom.drop), drop, 1e-6);
  EXPECT_NEAR(drop, 0.05, 0.006);  // 0.1 m in 2 m, to a pixel
}

TEST(CameraModel, ColumnOfInvertsTheDirection) {
  const auto camera = recon::make_camera_model(simple_camera());
  const auto rays = seen_by(camera, {30, 39, 59, 40});
  EXPECT_NEAR(recon::column_of(camera, rays.left.direction), 29.5F, 1e-3F);
  EXPECT_NEAR(recon::column_of(camera, rays.right.direction), 59.5F, 1e-3F);
  EXPECT_LT(recon::column_of(camera, {-1, 0.1F}), -1e4F);  // behind, to the left
  EXPECT_GT(recon::column_of(camera, {-1, -0.1F}), 1e4F);
}

}  // namespace
}  // namespace fencepost::test
