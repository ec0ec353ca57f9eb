// The camera `grove_i2c` on the two-wire bus.
#pragma once

#include <array>

#include "drivers/grove/grove.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct GroveI2c : grove::I2cCamera<board::I2c> {
  static constexpr std::array kCameras = {config::CameraId::kGroveI2c};
  explicit GroveI2c(const Opening& opening) : grove::I2cCamera<board::I2c>(board::i2c(), opening.camera_address()) {}
  static void start(const Opening& /*opening*/) { board::start_i2c(); }
};

}  // namespace fencepost::image
