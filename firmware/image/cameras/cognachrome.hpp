// The camera `cognachrome`, at 38400 baud. Its monitor begins at 9600 until the user types `baud 38400`.
#pragma once

#include <array>

#include "drivers/cognachrome/cognachrome.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Cognachrome : cognachrome::Camera<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kCognachrome};
  explicit Cognachrome(const Opening& /*opening*/)
      : cognachrome::Camera<board::Link>(board::camera(), cognachrome::Config{}) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
