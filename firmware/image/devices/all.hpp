// FENCEPOST_DEVICES=all: for a board with a line for a camera, a base line, a two-wire bus and encoders.
#pragma once

#include <cameras/all.hpp>

#include "firmware/image/odometry/console.hpp"
#include "firmware/image/odometry/create.hpp"
#include "firmware/image/odometry/encoders.hpp"
#include "firmware/image/odometry_choice.hpp"

namespace fencepost::image {

using Odometry = OdometryChoice<ConsoleOdometry, Encoders, Create>;

}  // namespace fencepost::image
