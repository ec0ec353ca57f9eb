// The camera `grove` on a serial line, at 921600 baud.
#pragma once

#include <array>

#include "drivers/grove/grove.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Grove : grove::Camera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kGrove};
  explicit Grove(const Opening& /*opening*/) : grove::Camera<board::Link>(board::camera()) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
