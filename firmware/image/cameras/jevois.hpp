// The camera `jevois` on a serial line, at 115200 baud; its module's things end in their signature's number: `blob2`.
#pragma once

#include <array>

#include "drivers/jevois/jevois.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct JeVois : jevois::JeVois<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kJevois};
  explicit JeVois(const Opening& /*opening*/) : jevois::JeVois<board::Link>(board::camera(), jevois::Config{}) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }
};

}  // namespace fencepost::image
