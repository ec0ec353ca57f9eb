// Shared by the calibrations of other programs.
#pragma once

#include <array>
#include <string>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// Integer pixels are their middles.
struct Pinhole {
  double width = 0;
  double height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3
};

/// errors: SegmentProblem: numbers that no camera has, or coefficients beyond k1 that move a corner of the image by
/// more than two pixels. `remedy` is for the second.
sensor::CameraIntrinsics to_camera(const Pinhole& pinhole, const char* model, const std::string& name,
                                   const char* remedy);

}  // namespace fencepost::host
