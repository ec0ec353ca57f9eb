// The cameras `pixy2_i2c` and `pixy2.1_i2c` on the two-wire bus; in PixyMon: interface I2C, address 0x54.
#pragma once

#include <array>

#include "drivers/pixy2/camera.hpp"
#include "firmware/image/cameras/two_wire.hpp"

namespace fencepost::image {

struct Pixy2I2c : TwoWireCamera<pixy2::Camera> {
  static constexpr std::array kCameras = {config::CameraId::kPixy2I2c, config::CameraId::kPixy21I2c};
  using TwoWireCamera::TwoWireCamera;
};

}  // namespace fencepost::image
