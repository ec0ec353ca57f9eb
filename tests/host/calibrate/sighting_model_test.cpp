// Predicted edges and rows against the simulator's exact rays.
#include "host/calibrate/sighting_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/geometry/rings.hpp"
#include "host/simulate/truth.hpp"

namespace fencepost::host {
namespace {

struct Camera {
  double yaw = 0;
  double pitch = 0;
  double k1 = 0;
  bool fisheye = false;  ///< equidistant, 150 degrees across
};

constexpr double kFocal = 273.6;
constexpr double kFisheye = 120.7;
constexpr double kLens = 0.13;  // m, height

ConfiguredOptics optics() { return {kFocal, kFocal, 157.5, 103.5, 316, 208}; }
ConfiguredOptics optics(const Camera& camera) {
  return camera.fisheye ? ConfiguredOptics{kFisheye, kFisheye, 157.5, 103.5, 316, 208, true} : optics();
}

CameraValues values_of(const Camera& camera) { return {0, camera.yaw, camera.pitch, 0, kLens, 0.05, 0.01, camera.k1}; }

calibration::View<double> view_of(const Camera& camera) {
  const CameraValues values = values_of(camera);
  return calibration::view_of<double>(optics(camera), values.data(), {0, 0, 0});
}

ObjectValues round(Point centre, double radius, double top) {
  ObjectValues values{};
  values[kCentreX] = centre.x;
  values[kCentreY] = centre.y;
  values[kRadius] = radius;
  values[kTop] = top;
  return values;
}

// A circle of 0.1 m at 1 m straight ahead of the lens: its tangents leave at asin(0.1), its foot is 0.9 m away.
TEST(SightingModel, IsWhatAPencilGives) {
  const Camera camera;
  const CameraValues values = values_of(camera);
  const auto view = view_of(camera);
  const ObjectValues object = round({1.05, 0.01}, 0.1, 0.2);
  Sighting sighting;
  sighting.row_low = 90;
  sighting.row_high = 143;
  const double half = kFocal * std::tan(std::asin(0.1));
  const auto edge = [&](double beside, double sign) {
    return calibration::edge_column(optics(), values.data(), view, object.data(), sighting, beside, sign);
  };
  EXPECT_NEAR(edge(157.5 - half, 1), 157.5 - half, 1e-9);
  EXPECT_NEAR(edge(157.5 + half, -1), 157.5 + half, 1e-9);
  // Asked two pixels beside it, the tangent there still tells where the edge is.
  EXPECT_NEAR(edge(157.5 - half - 2, 1), 157.5 - half, 0.05);
  EXPECT_NEAR(calibration::foot_row(optics(), values.data(), view, object.data(), 157.5), 103.5 + kFocal * kLens / 0.9,
              1e-9);
  EXPECT_NEAR(calibration::top_row(optics(), values.data(), view, object.data(), 157.5),
              103.5 + kFocal * (kLens - 0.2) / 0.9, 1e-9);
}

TEST(SightingModel, ASquaresHarmonicsMakeItsCorners) {
  ObjectValues object = round({0, 0}, 0.0637, 0.2);  // side 0.1: the mean of its support is 0.2 / pi
  object[kShape + 2 * 2] = -2 * 0.0637 / 15;         // m = 4
  EXPECT_NEAR(calibration::support(object.data(), 1.0, 0.0), 0.05, 0.006);
  EXPECT_NEAR(calibration::support(object.data(), std::sqrt(0.5), std::sqrt(0.5)), 0.0707, 0.004);
}

// Whatever the shape, the residual of an edge is the distance to where it was seen. A shape that makes it smaller by a
// factor would be bent by noise: yaws would be half a degree off.
TEST(SightingModel, AShapeDoesNotMakeResidualsSmaller) {
  const Camera camera;
  const CameraValues values = values_of(camera);
  const auto view = view_of(camera);
  ObjectValues object = round({0.65, 0.05}, 0.06, 0.2);
  object[kShape] = 0.008;
  object[kShape + 1] = -0.012;
  object[kShape + 3] = 0.006;
  Sighting sighting;
  sighting.row_low = 90;
  sighting.row_high = 143;
  for (const double sign : {1.0, -1.0}) {
    const auto edge = [&](double beside) {
      return calibration::edge_column(optics(), values.data(), view, object.data(), sighting, beside, sign);
    };
    double exact = 157.5;
    for (int i = 0; i < 20; ++i) exact = edge(exact);
    for (const double off : {-1.0, 1.0}) {
      // The remainder is curvature: of second order in a pixel.
      EXPECT_NEAR(edge(exact + off) - (exact + off), -off, 0.01) << sign;
    }
  }
}

struct Seen {
  Camera camera;
  Point centre;
  double radius;
  double top;
};

class RenderedCylinder : public testing::TestWithParam<Seen> {};

Scene scene_of(const Seen& seen) {
  Scene scene;
  sensor::CameraIntrinsics& camera = scene.camera;
  camera.model = "test";
  // Four times the pixels: whole ones are then a quarter of a pixel.
  camera.width = 4 * 316;
  camera.height = 4 * 208;
  camera.fx = camera.fy = base::Pixels2::nearest(4 * optics(seen.camera).fx);
  if (seen.camera.fisheye) camera.lens = sensor::Lens::kEquidistant;
  camera.cx = base::Pixels2::nearest(4 * 158 - 0.5);
  camera.cy = base::Pixels2::nearest(4 * 104 - 0.5);
  camera.k1 = base::Ratio4::nearest(seen.camera.k1);
  camera.mount = {base::Metres::nearest(0.05), base::Metres::nearest(0.01), base::Metres::nearest(kLens),
                  base::Radians::nearest(seen.camera.yaw), base::Radians::nearest(seen.camera.pitch)};
  scene.rate = 1;
  scene.signatures = {{1, "red", {208, 32, 32}}};
  SceneObject object;
  object.signature = 1;
  object.height_m = seen.top;
  object.footprint = {circle_ring(seen.centre, seen.radius), {}};
  scene.objects = {object};
  scene.path = PosesPath{{{0, 0, 0, 0}, {1, 0, 0, 0}}};
  return scene;
}

TEST_P(RenderedCylinder, HasItsEdgesWhereThePredictionHasThem) {
  const Seen& seen = GetParam();
  std::optional<sensor::Blob> blob;
  const auto simulated = simulate_with_truth(
      scene_of(seen), [](std::string_view) {},
      [&](const FrameTruth& truth) {
        if (!truth.frame.blobs.empty()) blob = truth.frame.blobs[0];
      });
  ASSERT_TRUE(simulated.ok());
  ASSERT_TRUE(blob.has_value());
  const auto coarse = [](double fine) { return (fine + 0.5) / 4 - 0.5; };
  Sighting sighting;
  sighting.left = coarse(blob->x1 - 0.5);
  sighting.right = coarse(blob->x2 + 0.5);
  sighting.row_low = coarse(blob->y1 - 0.5);
  sighting.row_high = coarse(blob->y2 + 0.5);
  sighting.middle = (*sighting.left + *sighting.right) / 2;
  const CameraValues values = values_of(seen.camera);
  const auto view = view_of(seen.camera);
  const ObjectValues object = round(seen.centre, seen.radius, seen.top);
  const auto edge = [&](double beside, double sign) {
    return calibration::edge_column(optics(seen.camera), values.data(), view, object.data(), sighting, beside, sign);
  };
  constexpr double kPixel = 0.30;  // an eighth by whole pixels, and as much for the box's corner
  EXPECT_NEAR(edge(*sighting.left, 1), *sighting.left, kPixel);
  EXPECT_NEAR(edge(*sighting.right, -1), *sighting.right, kPixel);
  EXPECT_NEAR(calibration::foot_row(optics(seen.camera), values.data(), view, object.data(), sighting.middle),
              sighting.row_high, kPixel);
  EXPECT_NEAR(calibration::top_row(optics(seen.camera), values.data(), view, object.data(), sighting.middle),
              sighting.row_low, kPixel);
}

INSTANTIATE_TEST_SUITE_P(All, RenderedCylinder,
                         testing::Values(Seen{{}, {1, 0}, 0.06, 0.2}, Seen{{}, {0.8, 0.25}, 0.06, 0.08},
                                         Seen{{0.05, 0, 0}, {0.9, -0.2}, 0.1, 0.2},
                                         Seen{{0, 0.1, 0}, {0.9, 0.3}, 0.05, 0.2},
                                         Seen{{0, 0.1, 0}, {0.9, -0.3}, 0.05, 0.07},
                                         Seen{{0.03, 0.08, -0.1}, {0.9, 0.25}, 0.05, 0.1},
                                         Seen{{0, -0.05, 0.1}, {1.2, -0.3}, 0.08, 0.2}));

// To 70 degrees off the axis, seen from above and from below their tops, pitched, with a k1 of their own.
INSTANTIATE_TEST_SUITE_P(Fisheye, RenderedCylinder,
                         testing::Values(Seen{{0, 0, 0, true}, {0.6, 0}, 0.05, 0.08},
                                         Seen{{0, 0, 0, true}, {0.4, 0.5}, 0.06, 0.08},
                                         Seen{{0, 0, 0, true}, {0.35, -0.6}, 0.06, 0.25},
                                         Seen{{0.05, 0.1, 0, true}, {0.35, 0.6}, 0.05, 0.08},
                                         Seen{{-0.05, 0.1, 0, true}, {0.35, -0.6}, 0.05, 0.2},
                                         Seen{{0, -0.1, 0, true}, {0.3, 0.6}, 0.05, 0.2},
                                         Seen{{0, 0.15, -0.04, true}, {0.35, 0.45}, 0.05, 0.1}));

// The derivative that fits use, against steps.
TEST(SightingModel, AMotionIsCorrectedByWhatTheWheelsReallyDo) {
  const WheelValues wheels = {0.02, 0.01, 0.05};
  const auto true_motion = calibration::corrected<double>({0.2, 0, 0.3, 0.2}, wheels.data());
  EXPECT_NEAR(true_motion.turn, 0.3 * 1.01 + 0.05 * 0.2, 1e-12);
  EXPECT_NEAR(std::hypot(true_motion.ahead, true_motion.left), 0.2 * 1.02, 1e-12);
}

}  // namespace
}  // namespace fencepost::host
