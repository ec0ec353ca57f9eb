// The camera `nxtcam`: an NXTCam or AVRcam by its serial pins, at 115200 baud.
#pragma once

#include <array>

#include "drivers/nxtcam/serial_camera.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct NxtCam : nxtcam::SerialCamera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kNxtcam};
  explicit NxtCam(const Opening& /*opening*/) : nxtcam::SerialCamera<board::Link>(board::camera()) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
