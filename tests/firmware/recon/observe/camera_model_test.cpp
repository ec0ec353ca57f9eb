#include "firmware/recon/observe/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

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

// 100 x 80 px: an end at 0, 1, 98 or 99, and a row at 0, 1, 78 or 79 is on the border.
TEST(CameraModel, APadComesOffSidesThatTheBorderDoesNotCut) {
  const auto camera = recon::make_camera_model(simple_camera());
  struct Case {
    const char* what;
    std::int16_t pad;
    recon::Box box;
    recon::Box bare;
  };
  const Case cases[] = {{"all sides", 4, {20, 10, 59, 49}, {24, 14, 55, 45}},
                        {"none", 0, {20, 10, 59, 49}, {20, 10, 59, 49}},
                        {"added", -4, {20, 10, 59, 49}, {16, 6, 63, 53}},
                        {"added as far as the image goes", -4, {2, 3, 97, 77}, {0, 0, 99, 79}},
                        {"cut at the left", 4, {1, 10, 59, 49}, {1, 14, 55, 45}},
                        {"cut at the right and above", 4, {20, 0, 98, 49}, {24, 0, 98, 45}},
                        {"cut below", 4, {20, 10, 59, 78}, {24, 14, 55, 78}},
                        {"cut all around", 4, {0, 0, 99, 79}, {0, 0, 99, 79}},
                        {"an odd size leaves its middle", 4, {20, 10, 24, 14}, {22, 12, 22, 12}},
                        {"an even size leaves two", 4, {20, 10, 23, 13}, {21, 11, 22, 12}},
                        {"one pixel stays", 100, {20, 10, 20, 10}, {20, 10, 20, 10}},
                        {"cut, and narrower than the pad", 100, {0, 10, 5, 49}, {0, 29, 0, 30}}};
  for (const Case& c : cases) {
    const recon::Box bare = recon::without_pad(camera, c.box, c.pad);
    EXPECT_TRUE(bare.x1 == c.bare.x1 && bare.y1 == c.bare.y1 && bare.x2 == c.bare.x2 && bare.y2 == c.bare.y2)
        << c.what << ": " << bare.x1 << ' ' << bare.y1 << ' ' << bare.x2 << ' ' << bare.y2;
  }
}

// Half a pixel of 316 columns is not half a pixel of 80.
TEST(CameraModel, CoarserPixelsHaveSharperEdges) {
  EXPECT_FLOAT_EQ(recon::nominal_edge_noise(316), 1.2F);
  EXPECT_FLOAT_EQ(recon::nominal_edge_noise(160), 1.2F);
  EXPECT_FLOAT_EQ(recon::nominal_edge_noise(128), 0.96F);
  EXPECT_FLOAT_EQ(recon::nominal_edge_noise(80), 0.75F);
  sensor::CameraIntrinsics coarse = simple_camera();
  coarse.width = 128;
  EXPECT_FLOAT_EQ(recon::make_camera_model(coarse).edge_px, 0.96F);
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
  // A point 2 m ahead, 0.3 m left, on the floor 0.1 m below the lens; the camera looks 0.05 rad down. The point is
  // 2 cos p + 0.1 sin p along the axis and 0.1 cos p - 2 sin p below it.
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

// 150 degrees: 150 px of focal length, half of 393 px is 75 degrees.
sensor::CameraIntrinsics fisheye(double k1 = 0, double pitch = 0) {
  sensor::CameraIntrinsics camera = simple_camera();
  camera.lens = sensor::Lens::kEquidistant;
  camera.width = 393;
  camera.height = 240;
  camera.fx = camera.fy = Pixels2::nearest(150);
  camera.cx = Pixels2::nearest(196);
  camera.cy = Pixels2::nearest(119.5);
  camera.k1 = base::Ratio4::nearest(k1);
  camera.mount.pitch = Radians::nearest(pitch);
  return camera;
}

// Forward, in double: r = f a (1 + k1 a^2), along the ray's own direction in the image.
std::pair<double, double> pixel_of(const sensor::CameraIntrinsics& camera, double ahead, double left, double down) {
  const double across = std::hypot(left, down);
  const double angle = std::atan2(across, ahead);
  const double radius = angle * (1 + camera.k1.to_double() * angle * angle);
  const double share = across > 0 ? radius / across : 0;
  return {camera.cx.to_double() - camera.fx.to_double() * left * share,
          camera.cy.to_double() + camera.fy.to_double() * down * share};
}

// A column is the same angle everywhere: 150 px to the left is one radian.
TEST(Fisheye, AColumnIsTheSameAngleEverywhere) {
  const recon::CameraModel camera = recon::make_camera_model(fisheye());
  for (const double angle : {-1.3, -1.0, -0.3, 0.0, 0.5, 1.0, 1.309}) {
    const recon::Vec2 direction = recon::ground_direction(camera, static_cast<float>(196 - 150 * angle), 119.5F);
    EXPECT_NEAR(static_cast<double>(direction.x()), std::cos(angle), 3e-6) << angle;
    EXPECT_NEAR(static_cast<double>(direction.y()), std::sin(angle), 3e-6) << angle;
    EXPECT_NEAR(recon::column_of(camera, direction), 196 - 150 * angle, 2e-3) << angle;
  }
}

// Through the lens and back, wherever the ray is within 75 degrees of the axis.
TEST(Fisheye, RaysComeBackFromTheirPixels) {
  int checked = 0;
  for (const double k1 : {-0.03, 0.0, 0.02}) {
    for (const double pitch : {0.0, 0.2}) {
      const sensor::CameraIntrinsics intrinsics = fisheye(k1, pitch);
      const recon::CameraModel camera = recon::make_camera_model(intrinsics);
      for (double bearing = -1.2; bearing <= 1.2; bearing += 0.15) {
        for (double drop = -0.3; drop <= 0.6; drop += 0.15) {  // per metre of depth
          const double left = std::tan(bearing);
          const double ahead = std::cos(pitch) + drop * std::sin(pitch);
          const double down = drop * std::cos(pitch) - std::sin(pitch);
          if (std::atan2(std::hypot(left, down), ahead) > 1.309) continue;
          const auto [u, v] = pixel_of(intrinsics, ahead, left, down);
          const recon::Vec2 direction = recon::ground_direction(camera, static_cast<float>(u), static_cast<float>(v));
          EXPECT_NEAR(std::atan2(direction.y(), direction.x()), bearing, 2e-5) << k1 << " " << pitch;
          const float fall = recon::drop_per_depth(camera, static_cast<float>(u), static_cast<float>(v));
          EXPECT_NEAR(static_cast<double>(fall), drop, 1e-4) << k1 << " " << pitch;
          float row = 0;
          ASSERT_TRUE(recon::row_of(camera, static_cast<float>(drop), static_cast<float>(left), row));
          EXPECT_NEAR(static_cast<double>(row), v, 0.01);
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 400);
}

// A post from 0.1 m below the lens to 0.3 m above it, 1 m ahead and 1.2 m to the left. Its image is a bow: the outer
// edge is farthest out on the horizon, the inner edge nearest to the middle at the top. These are the box's columns.
TEST(Fisheye, EdgesAreTakenWhereTheBowReachesFarthest) {
  const sensor::CameraIntrinsics intrinsics = fisheye();
  const recon::CameraModel camera = recon::make_camera_model(intrinsics);
  const auto column = [&](double left, double down) { return pixel_of(intrinsics, 1, left, down).first; };
  const auto row = [&](double left, double down) { return pixel_of(intrinsics, 1, left, down).second; };
  const recon::Box box{static_cast<std::int16_t>(std::lround(column(1.3, 0) + 0.5)),
                       static_cast<std::int16_t>(std::lround(row(1.2, -0.3) + 0.5)),
                       static_cast<std::int16_t>(std::lround(column(1.2, -0.3) - 0.5)),
                       static_cast<std::int16_t>(std::lround(row(1.2, 0.1) - 0.5))};
  const recon::Sighting sighting = seen_by(camera, box);
  const double pixel = 0.6 / 150;
  EXPECT_NEAR(std::atan2(sighting.left.direction.y(), sighting.left.direction.x()), std::atan(1.3), pixel);
  EXPECT_NEAR(std::atan2(sighting.right.direction.y(), sighting.right.direction.x()), std::atan(1.2), pixel);
  // In the middle row the inner edge is 0.4 columns of an angle farther in, the outer one as much: they do not cancel.
  EXPECT_EQ(recon::row_of_edge(camera, box, true), 119.5F);
  EXPECT_EQ(recon::row_of_edge(camera, box, false), recon::top_edge(box));
}

}  // namespace
}  // namespace fencepost::test
