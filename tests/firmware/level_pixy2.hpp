// The camera of most tests of the loop: a Pixy2's, level, 12 cm above the floor, over the robot's origin. Feet leave
// the image at 0.32 m.
#pragma once

#include "hal/sensor/camera.hpp"

namespace fencepost::test {

/// `latency`: s
inline sensor::CameraIntrinsics level_pixy2(double latency = 0.05) {
  sensor::CameraIntrinsics camera;
  camera.model = "pixy2";
  camera.width = 316;
  camera.height = 208;
  camera.fx = camera.fy = base::Pixels2::nearest(273.6);
  camera.cx = base::Pixels2::nearest(157.5);
  camera.cy = base::Pixels2::nearest(103.5);
  camera.mount.z = base::Metres::nearest(0.12);
  camera.mount.pitch = base::Radians{0};
  camera.latency = base::Duration::nearest(latency);
  return camera;
}

}  // namespace fencepost::test
