// FENCEPOST_DEVICES=two_wire: for a board with a two-wire bus and no serial line beside the console.
#pragma once

#include "firmware/image/camera_choice.hpp"
#include "firmware/image/cameras/console.hpp"
#include "firmware/image/cameras/huskylens_i2c.hpp"
#include "firmware/image/cameras/nxtcam_i2c.hpp"
#include "firmware/image/cameras/pixy1_i2c.hpp"
#include "firmware/image/cameras/pixy2_i2c.hpp"
#include "firmware/image/odometry/console.hpp"
#include "firmware/image/odometry_choice.hpp"

namespace fencepost::image {

using Camera = CameraChoice<ConsoleCamera, Pixy2I2c, HuskyLensI2c, NxtCamI2c, Pixy1I2c>;
using Odometry = OdometryChoice<ConsoleOdometry>;

}  // namespace fencepost::image
