// FENCEPOST_ODOMETRY=create2: an iRobot Create 2 or Roomba 600 on the board's base line.
#pragma once

#include "drivers/create/create.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Odometry : create::Create<board::Link> {
  explicit Odometry(const console::Counters& /*counters*/)
      : create::Create<board::Link>(board::base(), create::Config{}) {}
  static void start() { board::start_base(115'200); }
};

}  // namespace fencepost::image
