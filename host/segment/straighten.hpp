// Images as the reconstruction wants them: columns along the ground, on request without the lens's distortion.
#pragma once

#include <opencv2/core.hpp>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

struct Straightening {
  int rotate = 0;          ///< degrees clockwise: 0, 90, 180, 270
  bool undistort = false;  ///< takes k1 out of the image
};

/// Turns and undistorts images of one camera, and gives the calibration that they have then.
class Straightener {
 public:
  /// `camera`: of the images as the files have them; the mount is that of the upright camera.
  Straightener(const sensor::CameraIntrinsics& camera, const Straightening& wanted);

  [[nodiscard]] const sensor::CameraIntrinsics& camera() const { return camera_; }
  /// `image` of the size that the calibration had.
  [[nodiscard]] cv::Mat operator()(const cv::Mat& image) const;

 private:
  void make_maps();

  int rotate_;
  sensor::CameraIntrinsics camera_;
  cv::Mat source_u_;  ///< of each pixel; empty: nothing to undistort
  cv::Mat source_v_;
};

}  // namespace fencepost::host
