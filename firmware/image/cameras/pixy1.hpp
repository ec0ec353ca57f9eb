// The camera `pixy1` on a serial line; in PixyMon: data out port 3 (UART), 115200 baud.
#pragma once

#include <array>

#include "drivers/pixy1/pixy1.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Pixy1 : pixy1::Camera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kPixy1};
  explicit Pixy1(const Opening& /*opening*/) : pixy1::Camera<board::Link>(board::camera()) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
