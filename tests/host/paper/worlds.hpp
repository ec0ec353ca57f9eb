// A world whose every number can be worked out by hand.
#pragma once

#include "host/scene/scene.hpp"

namespace fencepost::host::testing {

/// A red and a yellow square of 10 cm, 20 cm high, at (1, 0.15) and (1, -0.15). The robot stands at the origin for
/// three frames, looking along x, then 0.15 and 0.3 rad to the left. The first two show both landmarks; in the third
/// yellow is beside the image.
inline Scene two_squares() {
  Scene scene;
  sensor::CameraIntrinsics& camera = scene.camera;
  camera.model = "test";
  camera.width = 200;
  camera.height = 120;
  camera.fx = camera.fy = base::Pixels2::nearest(200);
  camera.cx = base::Pixels2::nearest(99.5);
  camera.cy = base::Pixels2::nearest(59.5);
  camera.mount.z = base::Metres::nearest(0.15);
  camera.mount.pitch = base::Radians{0};
  scene.rate = 10;
  scene.signatures = {{1, "red", {200, 40, 40}}, {2, "yellow", {210, 190, 40}}};
  const auto square = [](double x, double y) {
    return Polygon{{{x - 0.05, y - 0.05}, {x + 0.05, y - 0.05}, {x + 0.05, y + 0.05}, {x - 0.05, y + 0.05}}, {}};
  };
  scene.objects = {{"red block", 1, 0, 0.2, square(1, 0.15)}, {"yellow block", 2, 0, 0.2, square(1, -0.15)}};
  scene.path = PosesPath{{{0, 0, 0, 0}, {0.1, 0, 0, 0.15}, {0.2, 0, 0, 0.4}}};
  return scene;
}

}  // namespace fencepost::host::testing
