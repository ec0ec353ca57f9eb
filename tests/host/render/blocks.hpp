// Small worlds for the tests of the renderers.
#pragma once

#include "host/render/solid.hpp"
#include "host/simulate/prism.hpp"

namespace fencepost::host::testing {

/// 200 px by 120 px, 200 px focal length, lens 15 cm above the floor, level.
inline sensor::CameraIntrinsics small_camera() {
  sensor::CameraIntrinsics camera;
  camera.width = 200;
  camera.height = 120;
  camera.fx = camera.fy = base::Pixels2::nearest(200);
  camera.cx = base::Pixels2::nearest(99.5);
  camera.cy = base::Pixels2::nearest(59.5);
  camera.mount.z = base::Metres::nearest(0.15);
  camera.mount.pitch = base::Radians{0};
  return camera;
}

/// At the origin, looking along x.
inline constexpr CameraPose kLens{0, 0, 0.15, 0};

inline Polygon rectangle(double x1, double y1, double x2, double y2) {
  return {{{x1, y1}, {x2, y1}, {x2, y2}, {x1, y2}}, {}};
}

inline Solid block(double x1, double y1, double x2, double y2, sensor::Rgb colour = {200, 40, 40}) {
  return {{rectangle(x1, y1, x2, y2)}, 0, 0.3, 1, colour, 0};
}

}  // namespace fencepost::host::testing
