#include "host/segment/straighten.hpp"

#include <gtest/gtest.h>

#include "tests/host/segment/pictures.hpp"

namespace fencepost::host {
namespace {

sensor::CameraIntrinsics uneven_camera() {
  sensor::CameraIntrinsics camera = camera_of(40, 24);
  camera.fx = base::Pixels2::nearest(100);
  camera.fy = base::Pixels2::nearest(110);
  camera.cx = base::Pixels2::nearest(21);
  camera.cy = base::Pixels2::nearest(9.5);
  return camera;
}

/// Where the only red pixel is.
cv::Point red_pixel(const cv::Mat& image) {
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      if (image.at<cv::Vec3b>(v, u) == bgr(kRed)) return {u, v};
    }
  }
  ADD_FAILURE() << "no red pixel";
  return {};
}

// A point (x, y) of the normalised image, right and down. Turned by 90 degrees clockwise it is at (-y, x).
TEST(Straighten, TheCalibrationTurnsWithTheImage) {
  const sensor::CameraIntrinsics camera = uneven_camera();
  cv::Mat image = canvas(40, 24, kWall);
  image.at<cv::Vec3b>(3, 30) = bgr(kRed);
  const double x = (30 - 21) / 100.0;
  const double y = (3 - 9.5) / 110.0;
  struct Turn {
    int degrees;
    double x, y;
  };
  for (const Turn& turn : {Turn{0, x, y}, Turn{90, -y, x}, Turn{180, -x, -y}, Turn{270, y, -x}}) {
    SCOPED_TRACE(turn.degrees);
    const Straightener straighten(camera, {turn.degrees, false});
    const cv::Mat upright = straighten(image);
    const sensor::CameraIntrinsics& turned = straighten.camera();
    EXPECT_EQ(upright.cols, turned.width);
    EXPECT_EQ(upright.rows, turned.height);
    const cv::Point at = red_pixel(upright);
    EXPECT_NEAR((at.x - turned.cx.to_double()) / turned.fx.to_double(), turn.x, 1e-9);
    EXPECT_NEAR((at.y - turned.cy.to_double()) / turned.fy.to_double(), turn.y, 1e-9);
    EXPECT_EQ(turned.mount, camera.mount);
  }
}

TEST(Straighten, UndistortionPutsPointsWhereAPinholeSeesThem) {
  sensor::CameraIntrinsics camera = camera_of(160, 120);
  camera.fx = base::Pixels2::nearest(100);
  camera.fy = camera.fx;
  camera.k1 = base::Ratio4::nearest(-0.2);
  // 0.6 to the right in an ideal image: 60 px; the lens shows it at 0.6 (1 - 0.2 * 0.36) = 0.5568: 56 px right of 79.5.
  cv::Mat image = canvas(160, 120, kWall);
  paint(image, 135, 0, 136, 119, kRed);
  const Straightener straighten(camera, {0, true});
  EXPECT_EQ(straighten.camera().k1.raw, 0);
  const cv::Mat straight = straighten(image);
  EXPECT_EQ(straight.at<cv::Vec3b>(60, 140), bgr(kRed)) << "79.5 + 60 = 139.5, in front of this column";
  EXPECT_EQ(straight.at<cv::Vec3b>(60, 135), bgr(kWall));
  const Straightener kept(camera, {0, false});
  EXPECT_EQ(kept.camera(), camera);
  EXPECT_EQ(cv::norm(kept(image), image, cv::NORM_INF), 0);
}

TEST(Straighten, TakesOutAFisheye) {
  sensor::CameraIntrinsics camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = base::Pixels2::nearest(100);
  camera.cx = base::Pixels2::nearest(79.5);
  camera.cy = base::Pixels2::nearest(59.5);
  camera.lens = sensor::Lens::kEquidistant;
  // 0.6 to the right in an ideal image, 60 px, is atan 0.6 = 0.5404 rad off the axis: 54 px right of 79.5.
  cv::Mat image = canvas(160, 120, kWall);
  paint(image, 133, 0, 134, 119, kRed);
  const Straightener straighten(camera, {0, true});
  EXPECT_EQ(straighten.camera().lens, sensor::Lens::kPinhole);
  const cv::Mat straight = straighten(image);
  EXPECT_EQ(straight.at<cv::Vec3b>(60, 140), bgr(kRed)) << "79.5 + 60 = 139.5, in front of this column";
  EXPECT_EQ(straight.at<cv::Vec3b>(60, 134), bgr(kWall));
}

}  // namespace
}  // namespace fencepost::host
