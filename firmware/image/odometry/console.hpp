// FENCEPOST_ODOMETRY=console: $FPODO comes over the console, from the robot's own controller.
#pragma once

#include "firmware/image/fed_by_console.hpp"

namespace fencepost::image {

struct Odometry : OdometryOnConsole {
  using OdometryOnConsole::OdometryOnConsole;
  static void start() {}
};

}  // namespace fencepost::image
