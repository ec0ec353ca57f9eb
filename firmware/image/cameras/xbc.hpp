// The camera `xbc`: a KIPR XBC that runs fencepost_xbc.ic, at 38400 baud.
#pragma once

#include <array>

#include "drivers/xbc/xbc.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Xbc : xbc::Xbc<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kXbc};
  explicit Xbc(const Opening& /*opening*/) : xbc::Xbc<board::Link>(board::camera(), xbc::Config{}) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
