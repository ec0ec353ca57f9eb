// FENCEPOST_DEVICES=two_wire: for a board with a two-wire bus and no serial line beside the console.
#pragma once

#include <cameras/two_wire.hpp>

#include "firmware/image/odometry/console.hpp"
#include "firmware/image/odometry_choice.hpp"

namespace fencepost::image {

using Odometry = OdometryChoice<ConsoleOdometry>;

}  // namespace fencepost::image
