// FENCEPOST_CAMERA=console: $FPCAM and $FPFRM come over the console.
#pragma once

#include "firmware/image/fed_by_console.hpp"

namespace fencepost::image {

inline constexpr sensor::CameraIntrinsics kCamera = {};  // unknown until $FPCAM comes

struct Camera : CameraOnConsole {
  using CameraOnConsole::CameraOnConsole;
  static void start() {}
};

}  // namespace fencepost::image
