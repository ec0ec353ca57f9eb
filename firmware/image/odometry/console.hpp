// The odometry `console`: $FPODO comes over the console, from the robot's own controller.
#pragma once

#include <array>

#include "firmware/image/fed_by_console.hpp"
#include "firmware/image/opening.hpp"

namespace fencepost::image {

struct ConsoleOdometry : OdometryOnConsole {
  static constexpr std::array kOdometries = {config::OdometryId::kConsole};
  explicit ConsoleOdometry(const Opening& opening) : OdometryOnConsole(opening.counters) {}
  static void start(const Opening& /*opening*/) {}
};

}  // namespace fencepost::image
