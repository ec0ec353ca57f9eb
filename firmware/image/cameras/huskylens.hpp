// The camera `huskylens` on a serial line; in its settings: protocol type UART 9600.
#pragma once

#include <array>

#include "drivers/huskylens/huskylens.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct HuskyLens : huskylens::Camera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kHuskylens};
  explicit HuskyLens(const Opening& /*opening*/) : huskylens::Camera<board::Link>(board::camera()) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
