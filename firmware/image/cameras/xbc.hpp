// FENCEPOST_CAMERA=xbc: a KIPR XBC that runs fencepost_xbc.ic, at 38400 baud.
#pragma once

#include "drivers/xbc/xbc.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Camera : xbc::Xbc<board::Link> {
  explicit Camera(const console::Counters& /*counters*/) : xbc::Xbc<board::Link>(board::camera(), xbc::Config{}) {}
  static void start() { board::start_camera(38'400); }
  static sensor::CameraIntrinsics calibration() { return xbc::nominal_intrinsics({}); }
};

}  // namespace fencepost::image
