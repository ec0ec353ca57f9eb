// FENCEPOST_CAMERA=nxtcam: an NXTCam or AVRcam by its serial pins, at 115200 baud.
#pragma once

#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Camera : nxtcam::SerialCamera<board::Link> {
  explicit Camera(const console::Counters& /*counters*/) : nxtcam::SerialCamera<board::Link>(board::camera()) {}
  static void start() { board::start_camera(115'200); }
  static sensor::CameraIntrinsics calibration() { return nxtcam::kProfile; }
};

}  // namespace fencepost::image
