// FENCEPOST_DEVICES=console: for a board with nothing but its console.
#pragma once

#include "firmware/image/camera_choice.hpp"
#include "firmware/image/cameras/console.hpp"
#include "firmware/image/odometry/console.hpp"
#include "firmware/image/odometry_choice.hpp"

namespace fencepost::image {

using Camera = CameraChoice<ConsoleCamera>;
using Odometry = OdometryChoice<ConsoleOdometry>;

}  // namespace fencepost::image
