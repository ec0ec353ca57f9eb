// The camera `console`: $FPCAM and $FPFRM come over the console. Its calibration is not known until $FPCAM comes.
#pragma once

#include <array>

#include "firmware/image/fed_by_console.hpp"
#include "firmware/image/opening.hpp"

namespace fencepost::image {

struct ConsoleCamera : CameraOnConsole {
  static constexpr std::array kCameras = {config::CameraId::kConsole};
  explicit ConsoleCamera(const Opening& opening) : CameraOnConsole(opening.counters) {}
  static void start(const Opening& /*opening*/) {}
};

}  // namespace fencepost::image
