// Calibrations as COLMAP writes them: cameras.txt.
#pragma once

#include <string>
#include <string_view>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// Its first line that is no comment is CAMERA_ID MODEL WIDTH HEIGHT and numbers.
bool is_colmap_calibration(std::string_view text);

/// SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL and OPENCV; of several cameras all must be the same. COLMAP counts
/// pixels from the image's corner, we from the first one's middle. The mount is the robot's and stays at its origin
/// with unknown pitch. errors: SegmentProblem: another model, or coefficients beyond k1 that move a corner of the image
/// by more than two pixels
sensor::CameraIntrinsics parse_colmap_calibration(std::string_view text, const std::string& name);

}  // namespace fencepost::host
