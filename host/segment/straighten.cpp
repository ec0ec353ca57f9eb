#include "host/segment/straighten.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace fencepost::host {

namespace {

/// The calibration of an image that was turned by 90 degrees clockwise: (u, v) went to (height - 1 - v, u).
sensor::CameraIntrinsics turned(sensor::CameraIntrinsics camera) {
  const auto last_row = base::Pixels2::nearest(camera.height - 1);
  const base::Pixels2 cx{last_row.raw - camera.cy.raw};
  camera.cy = camera.cx;
  camera.cx = cx;
  std::swap(camera.fx, camera.fy);
  std::swap(camera.width, camera.height);
  return camera;
}

}  // namespace

Straightener::Straightener(const sensor::CameraIntrinsics& camera, const Straightening& wanted)
    : rotate_(wanted.rotate), camera_(camera) {
  for (int angle = 0; angle < rotate_; angle += 90) camera_ = turned(camera_);
  const bool bent = camera_.k1.raw != 0 || camera_.lens != sensor::Lens::kPinhole;
  if (wanted.undistort && bent) make_maps();
}

void Straightener::make_maps() {
  source_u_.create(camera_.height, camera_.width, CV_32F);
  source_v_.create(camera_.height, camera_.width, CV_32F);
  const double k1 = camera_.k1.to_double();
  for (int v = 0; v < camera_.height; ++v) {
    for (int u = 0; u < camera_.width; ++u) {
      const double x = (u - camera_.cx.to_double()) / camera_.fx.to_double();
      const double y = (v - camera_.cy.to_double()) / camera_.fy.to_double();
      const double radius = std::hypot(x, y);
      const bool equidistant = camera_.lens == sensor::Lens::kEquidistant && radius > 0;
      const double angle = equidistant ? std::atan(radius) : radius;
      const double scale = (1 + k1 * angle * angle) * (equidistant ? angle / radius : 1);
      source_u_.at<float>(v, u) = static_cast<float>(camera_.cx.to_double() + camera_.fx.to_double() * x * scale);
      source_v_.at<float>(v, u) = static_cast<float>(camera_.cy.to_double() + camera_.fy.to_double() * y * scale);
    }
  }
  camera_.k1 = {};
  camera_.lens = sensor::Lens::kPinhole;
}

cv::Mat Straightener::operator()(const cv::Mat& image) const {
  cv::Mat upright;
  if (rotate_ == 0) upright = image;
  if (rotate_ == 90) cv::rotate(image, upright, cv::ROTATE_90_CLOCKWISE);
  if (rotate_ == 180) cv::rotate(image, upright, cv::ROTATE_180);
  if (rotate_ == 270) cv::rotate(image, upright, cv::ROTATE_90_COUNTERCLOCKWISE);
  if (source_u_.empty()) return upright;
  cv::Mat straight;
  cv::remap(upright, straight, source_u_, source_v_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return straight;
}

}  // namespace fencepost::host
