// The cameras `huskylens_i2c` and `huskylens2_i2c` on the two-wire bus; in their settings: protocol type I2C.
#pragma once

#include <array>

#include "drivers/huskylens/huskylens.hpp"
#include "firmware/image/cameras/two_wire.hpp"

namespace fencepost::image {

struct HuskyLensI2c : TwoWireCamera<huskylens::Camera> {
  static constexpr std::array kCameras = {config::CameraId::kHuskylensI2c, config::CameraId::kHuskylens2I2c};
  explicit HuskyLensI2c(const Opening& opening)
      : TwoWireCamera(opening,
                      huskylens::Options{.generation = opening.devices.camera() == config::CameraId::kHuskylens2I2c
                                                           ? huskylens::Generation::kTwo
                                                           : huskylens::Generation::kOne}) {}
};

}  // namespace fencepost::image
