// FENCEPOST_CAMERA=huskylens: a HuskyLens on a serial line; in its settings: protocol type UART 9600.
#pragma once

#include "drivers/huskylens/huskylens.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Camera : huskylens::Camera<board::Link> {
  explicit Camera(const console::Counters& /*counters*/) : huskylens::Camera<board::Link>(board::camera()) {}
  static void start() { board::start_camera(9'600); }
  static sensor::CameraIntrinsics calibration() { return huskylens::kProfile; }
};

}  // namespace fencepost::image
