// FENCEPOST_CAMERA=console: $FPCAM and $FPFRM come over the console.
#pragma once

#include "firmware/image/fed_by_console.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::image {

struct Camera : CameraOnConsole {
  using CameraOnConsole::CameraOnConsole;
  static void start() {}
  /// Not known until $FPCAM comes.
  static sensor::CameraIntrinsics calibration() { return {}; }
};

}  // namespace fencepost::image
