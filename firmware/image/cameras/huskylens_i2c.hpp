// The camera `huskylens_i2c` on the two-wire bus; in its settings: protocol type I2C.
#pragma once

#include <array>

#include "drivers/huskylens/huskylens.hpp"
#include "firmware/image/cameras/two_wire.hpp"

namespace fencepost::image {

struct HuskyLensI2c : TwoWireCamera<huskylens::Camera> {
  static constexpr std::array kCameras = {config::CameraId::kHuskylensI2c};
  using TwoWireCamera::TwoWireCamera;
};

}  // namespace fencepost::image
