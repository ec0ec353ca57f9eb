// The odometries `create1` and `create2`: an iRobot Create 1, a Create 2 or Roomba 600, on the board's base line. With
// the setting `drive` it goes straight on while the robot may.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/create/create.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct Create : create::Create<board::Link> {
  static constexpr std::array kOdometries = {config::OdometryId::kCreate1, config::OdometryId::kCreate2};
  explicit Create(const Opening& opening) : create::Create<board::Link>(board::base(), wanted(opening)) {
    const auto speed = static_cast<std::int16_t>(opening.devices.raw(config::DeviceKey::kDrive));
    if (speed != 0) session().drive({speed, create::Motion::kStraight});
  }
  static void start(const Opening& opening) { board::start_base(opening.base_baud()); }

 private:
  static create::Config wanted(const Opening& opening) {
    const bool first = opening.devices.odometry() == config::OdometryId::kCreate1;
    const bool drives = opening.devices.raw(config::DeviceKey::kDrive) != 0;
    return {first ? create::Model::kCreate1 : create::Model::kCreate2,
            drives ? create::Mode::kSafe : create::Mode::kPassive,
            first ? odometry::kCreate1Wheels : odometry::kCreate2Wheels};
  }
};

}  // namespace fencepost::image
