// Calibrations as OpenCV's programs and ROS's camera_calibration write them.
#pragma once

#include <string>
#include <string_view>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// It begins as YAML does that has a camera_matrix.
bool is_opencv_calibration(std::string_view text);

/// image_width, image_height, camera_matrix and distortion_coefficients (k1, k2, p1, p2, k3) of a pinhole. The mount is
/// the robot's and stays at its origin with unknown pitch. errors: SegmentProblem: keys that are missing, or
/// coefficients beyond k1 that move a corner of the image by more than two pixels
sensor::CameraIntrinsics parse_opencv_calibration(std::string_view text, const std::string& name);

}  // namespace fencepost::host
