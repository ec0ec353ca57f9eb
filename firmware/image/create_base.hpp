// What the choices create1 and create2 share; FENCEPOST_DRIVE is how fast the robot goes straight on while it may,
// mm/s.
#pragma once

#include "drivers/create/create.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

template <create::Model kModel, std::uint32_t kBaud>
struct CreateBase : create::Create<board::Link> {
  explicit CreateBase(const console::Counters& /*counters*/)
      : create::Create<board::Link>(board::base(), create::Config{kModel, kMode, odometry::kCreate2Wheels}) {
    if constexpr (kDrives) session().drive({FENCEPOST_DRIVE, create::Motion::kStraight});
  }
  static void start() { board::start_base(kBaud); }

 private:
  static constexpr bool kDrives = FENCEPOST_DRIVE != 0;
  static constexpr create::Mode kMode = kDrives ? create::Mode::kSafe : create::Mode::kPassive;
};

}  // namespace fencepost::image
