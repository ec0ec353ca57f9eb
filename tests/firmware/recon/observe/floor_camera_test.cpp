#include "firmware/recon/observe/floor_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/tuning.hpp"

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::FloorCamera;
using recon::FloorPoint;
using recon::kSlopeOne;

sensor::CameraIntrinsics pixy(double pitch = 0, double k1 = 0, double height = 0.12) {
  sensor::CameraIntrinsics camera;
  camera.width = 316;
  camera.height = 208;
  camera.fx = camera.fy = base::Pixels2::nearest(273.6);
  camera.cx = base::Pixels2::nearest(157.5);
  camera.cy = base::Pixels2::nearest(103.5);
  camera.k1 = base::Ratio4::nearest(k1);
  camera.mount.z = base::Metres::nearest(height);
  camera.mount.pitch = base::Radians::nearest(pitch);
  return camera;
}

FloorCamera floor_of(const sensor::CameraIntrinsics& camera) { return FloorCamera(recon::make_camera_model(camera)); }

// Level: 80 rows below the horizon the ray falls 80 / 273.6 m a metre: 0.12 m in 410 mm. 40 columns to the left of the
// middle it goes 40 / 273.6 of that to the left.
TEST(FloorCamera, MeetsTheFloorWhereTheRayDoes) {
  const FloorCamera floor = floor_of(pixy());
  ASSERT_TRUE(floor.usable());
  const FloorPoint point = floor.at(2 * 117 + 1, 2 * 183 + 1);
  EXPECT_NEAR(point.depth, 410, 1);
  EXPECT_NEAR(point.slope / double{kSlopeOne}, 40 / 273.6, 1e-3);
}

TEST(FloorCamera, AboveTheHorizonNothingIsOnTheFloor) {
  const FloorCamera floor = floor_of(pixy());
  EXPECT_EQ(floor.at(100, 2 * 103).depth, FloorPoint::kNowhere);
  EXPECT_EQ(floor.at(100, 2 * 20).depth, FloorPoint::kNowhere);
  EXPECT_EQ(floor.at(100, 2 * 105).depth, FloorPoint::kNowhere) << "22 m away is nowhere";
}

// Everywhere on the floor, with pitch and distortion, as the floats of the camera model say.
TEST(FloorCamera, AgreesWithTheCameraModel) {
  for (const double pitch : {-0.1, 0.0, 0.05, 0.3}) {
    for (const double k1 : {-0.25, -0.1, 0.0, 0.1}) {
      const recon::CameraModel camera = recon::make_camera_model(pixy(pitch, k1));
      const FloorCamera floor(camera);
      for (int u = 0; u <= 316; u += 20) {
        for (int v = 40; v <= 208; v += 8) {
          const auto x = static_cast<float>(u), y = static_cast<float>(v);
          const float drop = recon::drop_per_depth(camera, x, y);
          if (drop * 1.5F < 0.12F) continue;  // farther than 1.5 m
          const recon::Vec2 direction = recon::ground_direction(camera, x, y);
          const FloorPoint point = floor.at(2 * u, 2 * v);
          const double depth = 120 / static_cast<double>(drop);
          EXPECT_NEAR(point.depth, depth, 2 + 0.01 * depth) << u << " " << v << " pitch " << pitch << " k1 " << k1;
          EXPECT_NEAR(point.slope / double{kSlopeOne}, direction.y() / direction.x(), 0.012) << u << " " << v;
        }
      }
    }
  }
}

// The last row that the border does not cut ends at 205.5: 102 / 273.6 m a metre, 322 mm, and a sixteenth.
TEST(FloorCamera, KnowsWhatItMustSee) {
  const FloorCamera floor = floor_of(pixy());
  EXPECT_NEAR(floor.nearest_visible(), 342, 2);
  EXPECT_NEAR(floor.leftmost_visible() / double{kSlopeOne}, (157.5 - recon::kTouchPixels) / 273.6, 2e-3);
  EXPECT_NEAR(floor.rightmost_visible() / double{kSlopeOne}, (157.5 - 315 + recon::kTouchPixels) / 273.6, 2e-3);
}

// At 0.5 m a row is 0.25 / (273.6 * 0.12) m = 7.6 mm, a column 500 / 273.6 mm.
TEST(FloorCamera, KnowsWhatAPixelIsWorth) {
  const FloorCamera floor = floor_of(pixy());
  EXPECT_NEAR(floor.depth_of_row(500), 7.6, 1);
  EXPECT_NEAR(floor.width_of_column(500), 1.8, 1);
}

TEST(FloorCamera, SaysWhenRowsTellNothing) {
  sensor::CameraIntrinsics unknown = pixy();
  unknown.mount.pitch.reset();
  EXPECT_FALSE(floor_of(unknown).usable());
  EXPECT_FALSE(floor_of(pixy(0, 0, 0)).usable());
  EXPECT_FALSE(floor_of(pixy(0, 0, 5)).usable());
  sensor::CameraIntrinsics wide = pixy();
  wide.fx = base::Pixels2::nearest(60);
  EXPECT_FALSE(floor_of(wide).usable());
}

// Whatever a calibration may be, no integer overflows (run with the sanitizers).
TEST(FloorCamera, HoldsAnyCalibration) {
  for (const double focal : {80.0, 300.0, 20'000.0}) {
    for (const double k1 : {-3.0, 3.0}) {
      for (const double pitch : {-1.5, 1.5, 3.1}) {
        for (const double height : {0.0015, 0.3, 3.9}) {
          sensor::CameraIntrinsics camera = pixy(pitch, k1, height);
          camera.fx = camera.fy = base::Pixels2::nearest(focal);
          const FloorCamera floor = floor_of(camera);
          for (int u = -2; u < 640; u += 9) {
            for (int v = -2; v < 420; v += 9) {
              const FloorPoint point = floor.at(u, v);
              EXPECT_GE(point.depth, 0);
              EXPECT_LE(point.depth, FloorPoint::kNowhere);
              EXPECT_LE(std::abs(point.slope), 4 * kSlopeOne);
              EXPECT_GE(floor.depth_of_row(std::min(point.depth, 2000)), 0);
            }
          }
        }
      }
    }
  }
}

// A fisheye's 150 degrees: as the floats of the camera model say, to 1.5 m.
TEST(FloorCamera, AgreesWithTheCameraModelOfAFisheye) {
  int compared = 0;
  for (const double pitch : {0.0, 0.15}) {
    for (const double k1 : {0.0, -0.02}) {
      sensor::CameraIntrinsics fisheye = pixy(pitch, k1);
      fisheye.lens = sensor::Lens::kEquidistant;
      fisheye.fx = fisheye.fy = base::Pixels2::nearest(120.7);
      const recon::CameraModel camera = recon::make_camera_model(fisheye);
      const FloorCamera floor(camera);
      ASSERT_TRUE(floor.usable());
      for (int u = 4; u <= 312; u += 11) {
        for (int v = 104; v <= 206; v += 6) {
          const auto x = static_cast<float>(u), y = static_cast<float>(v);
          const float drop = recon::drop_per_depth(camera, x, y);
          if (drop * 1.5F < 0.12F) continue;  // farther than 1.5 m
          const recon::Vec2 direction = recon::ground_direction(camera, x, y);
          const float slope = direction.y() / direction.x();
          if (std::fabs(slope) > 3.5F || !(direction.x() > 0.2F)) continue;
          const FloorPoint point = floor.at(2 * u, 2 * v);
          const float depth = 120.0F / drop;
          EXPECT_NEAR(static_cast<float>(point.depth), depth, 2 + 0.004F * depth) << u << " " << v << " " << pitch;
          EXPECT_NEAR(static_cast<float>(point.slope) / kSlopeOne, slope, 0.004F * (1 + slope * slope))
              << u << " " << v;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 500);
}

// Whole numbers all the way: every point of a coarse image, through lenses of each kind.
TEST(FloorCamera, OfEachPointOfTheImage) {
  Sweep sweep;
  for (const double pitch : {-0.2, 0.0, 0.1, 0.35, 1.3}) {
    for (const double k1 : {-0.3, 0.0, 0.2}) {
      for (const sensor::Lens lens : {sensor::Lens::kPinhole, sensor::Lens::kEquidistant}) {
        sensor::CameraIntrinsics camera = pixy(pitch, k1, 0.25);
        camera.lens = lens;
        camera.fy = base::Pixels2::nearest(lens == sensor::Lens::kPinhole ? 90 : 270);
        const FloorCamera floor = floor_of(camera);
        sweep.tell("nearest", floor.nearest_visible());
        sweep.tell("leftmost", floor.leftmost_visible());
        sweep.tell("rightmost", floor.rightmost_visible());
        sweep.tell("row", floor.depth_of_row(500));
        sweep.tell("column", floor.width_of_column(500));
        for (int u = -40; u <= 700; u += 37) {
          for (int v = -40; v <= 500; v += 27) {
            const FloorPoint point = floor.at(u, v);
            sweep.tell("depth", point.depth == FloorPoint::kNowhere ? 0 : point.depth);
            sweep.tell("slope", point.slope);
            sweep.tell("pair", floor.at(u, u + 9, v).right.slope);
          }
        }
      }
    }
  }
  expect_said(sweep, {"nearest 30 97ebfbac", "leftmost 24 edeef6fe", "rightmost 24 95a66e92", "row 30 202d3456",
                      "column 30 e8309129", "depth 7373 a20f9f04", "slope 12224 affad90d", "pair 12223 acd0ddd2"});
}

TEST(FloorCamera, NeedsAHeightFromAMillimetreToFourMetresAndAPinholesImage) {
  recon::CameraModel camera = recon::make_camera_model(pixy());
  const auto usable = [&] { return FloorCamera(camera).usable(); };
  for (const auto& [height, good] :
       {std::pair{0.0F, false}, {0.0009F, false}, {0.001F, true}, {4.0F, true}, {4.001F, false}}) {
    camera.height = height;
    EXPECT_EQ(usable(), good) << height;
  }
  camera.height = 0.12F;
  camera.pitch_known = false;
  EXPECT_FALSE(usable());
  camera.pitch_known = true;
  camera.fx = 79;  // 316 columns are four of that
  EXPECT_FALSE(usable());
  camera.fx = 79.25F;
  EXPECT_TRUE(usable());
  camera.fy = 52;  // of 208 rows
  EXPECT_FALSE(usable());
  camera.fy = 52.25F;
  EXPECT_TRUE(usable());
}

}  // namespace
}  // namespace fencepost::test
