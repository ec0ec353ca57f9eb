// FENCEPOST_CAMERA=nxtcam_i2c: an NXTCam on the two-wire bus.
#pragma once

#include "drivers/nxtcam/camera.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Camera : nxtcam::Camera<board::I2c> {
  explicit Camera(const console::Counters& /*counters*/) : nxtcam::Camera<board::I2c>(board::i2c()) {}
  static void start() { board::start_i2c(); }
  static sensor::CameraIntrinsics calibration() { return nxtcam::kProfile; }
};
static_assert(sensor::BlobCamera<Camera>);

}  // namespace fencepost::image
