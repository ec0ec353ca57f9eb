// The camera of the published tables and of the paper's figures.
#pragma once

#include <cmath>
#include <numbers>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// 176 x 144 px, 43 degrees wide as the paper's, level, 15 cm above the floor, over the robot's origin.
inline sensor::CameraIntrinsics table_camera(const char* model) {
  constexpr double kHalfWidth = 43 * std::numbers::pi / 360;
  sensor::CameraIntrinsics camera;
  camera.model = model;
  camera.width = 176;
  camera.height = 144;
  camera.fx = camera.fy = base::Pixels2::nearest(88 / std::tan(kHalfWidth));
  camera.cx = base::Pixels2::nearest(87.5);
  camera.cy = base::Pixels2::nearest(71.5);
  camera.mount.z = base::Metres::nearest(0.15);
  camera.mount.pitch = base::Radians{0};
  return camera;
}

}  // namespace fencepost::host
