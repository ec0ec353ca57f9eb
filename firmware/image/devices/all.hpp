// FENCEPOST_DEVICES=all: for a board with a line for a camera, a base line, a two-wire bus and encoders.
#pragma once

#include "firmware/image/camera_choice.hpp"
#include "firmware/image/cameras/cmucam.hpp"
#include "firmware/image/cameras/cognachrome.hpp"
#include "firmware/image/cameras/console.hpp"
#include "firmware/image/cameras/huskylens.hpp"
#include "firmware/image/cameras/huskylens_i2c.hpp"
#include "firmware/image/cameras/jevois.hpp"
#include "firmware/image/cameras/nxtcam.hpp"
#include "firmware/image/cameras/nxtcam_i2c.hpp"
#include "firmware/image/cameras/pixy1.hpp"
#include "firmware/image/cameras/pixy1_i2c.hpp"
#include "firmware/image/cameras/pixy2.hpp"
#include "firmware/image/cameras/pixy2_i2c.hpp"
#include "firmware/image/cameras/xbc.hpp"
#include "firmware/image/odometry/console.hpp"
#include "firmware/image/odometry/create.hpp"
#include "firmware/image/odometry/encoders.hpp"
#include "firmware/image/odometry_choice.hpp"

namespace fencepost::image {

/// In the order in which a turn of the loop asks which it is.
using Camera = CameraChoice<ConsoleCamera, Pixy2, Pixy2I2c, CmuCam, HuskyLens, HuskyLensI2c, NxtCam, NxtCamI2c, Xbc,
                            Pixy1, Pixy1I2c, Cognachrome, JeVois>;
using Odometry = OdometryChoice<ConsoleOdometry, Encoders, Create>;

}  // namespace fencepost::image
