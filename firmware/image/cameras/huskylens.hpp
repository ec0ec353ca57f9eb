// The cameras `huskylens` and `huskylens2` on a serial line; in their settings: protocol type UART, 9600 or 115200
// baud.
#pragma once

#include <array>

#include "drivers/huskylens/huskylens.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct HuskyLens : huskylens::Camera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kHuskylens, config::CameraId::kHuskylens2};
  explicit HuskyLens(const Opening& opening)
      : huskylens::Camera<board::Link>(
            board::camera(),
            {.generation = opening.devices.camera() == config::CameraId::kHuskylens2 ? huskylens::Generation::kTwo
                                                                                     : huskylens::Generation::kOne}) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
