// The camera `pixy1_i2c` on the two-wire bus; in PixyMon: data out port 2 (I2C), address 0x54.
#pragma once

#include <array>

#include "drivers/pixy1/pixy1.hpp"
#include "firmware/image/cameras/two_wire.hpp"

namespace fencepost::image {

struct Pixy1I2c : TwoWireCamera<pixy1::Camera> {
  static constexpr std::array kCameras = {config::CameraId::kPixy1I2c};
  using TwoWireCamera::TwoWireCamera;
};

}  // namespace fencepost::image
