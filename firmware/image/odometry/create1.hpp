// FENCEPOST_ODOMETRY=create1: an iRobot Create 1 on the board's base line.
#pragma once

#include "drivers/create/create.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Odometry : create::Create<board::Link> {
  explicit Odometry(const console::Counters& /*counters*/)
      : create::Create<board::Link>(
            board::base(), create::Config{create::Model::kCreate1, create::Mode::kPassive, odometry::kCreate2Wheels}) {}
  static void start() { board::start_base(57'600); }
};

}  // namespace fencepost::image
