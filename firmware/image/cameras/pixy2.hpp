// The cameras `pixy2` and `pixy2.1` on a serial line; in PixyMon: interface UART, 115200 baud. They differ in the lens.
#pragma once

#include <array>

#include "drivers/pixy2/camera.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Pixy2 : pixy2::Camera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kPixy2, config::CameraId::kPixy21};
  explicit Pixy2(const Opening& /*opening*/) : pixy2::Camera<board::Link>(board::camera()) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
