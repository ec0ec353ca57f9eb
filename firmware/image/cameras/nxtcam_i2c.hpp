// The camera `nxtcam_i2c`: an NXTCam on the two-wire bus.
#pragma once

#include <array>

#include "drivers/nxtcam/camera.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct NxtCamI2c : nxtcam::Camera<board::I2c> {
  static constexpr std::array kCameras = {config::CameraId::kNxtcamI2c};
  explicit NxtCamI2c(const Opening& opening)
      : nxtcam::Camera<board::I2c>(board::i2c(), nxtcam::Options{}, opening.camera_address()) {}
  static void start(const Opening& /*opening*/) { board::start_i2c(); }
};

}  // namespace fencepost::image
