// FENCEPOST_CAMERA=pixy2: a Pixy2 on a serial line; in PixyMon: interface UART, 115200 baud.
#pragma once

#include "drivers/pixy2/camera.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Camera : pixy2::Camera<board::Link> {
  explicit Camera(const console::Counters& /*counters*/) : pixy2::Camera<board::Link>(board::camera()) {}
  static void start() { board::start_camera(115'200); }
  static sensor::CameraIntrinsics calibration() { return pixy2::kPixy2Profile; }
};

}  // namespace fencepost::image
