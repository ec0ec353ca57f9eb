// The cameras that a board's image can have: the one list that a new one joins, behind all others.
#pragma once

#include "drivers/cmucam/dialect.hpp"
#include "drivers/cognachrome/session.hpp"
#include "drivers/grove/grove.hpp"
#include "drivers/huskylens/huskylens.hpp"
#include "drivers/jevois/session.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/xbc/session.hpp"

// X(CameraId, name, port, baud of a line, address on the two-wire bus, calibration as its maker says it). Images carry
// the numbers of CameraId: the order stays.
// clang-format off
#define FENCEPOST_CAMERAS(X)                                                                               \
  X(kConsole, "console", kConsole, 0, 0, sensor::CameraIntrinsics{})                                       \
  X(kPixy2, "pixy2", kLine, 115'200, 0, pixy2::kPixy2Profile)                                              \
  X(kPixy21, "pixy2.1", kLine, 115'200, 0, pixy2::kPixy21Profile)                                          \
  X(kPixy2I2c, "pixy2_i2c", kTwoWire, 0, 0x54, pixy2::kPixy2Profile)                                       \
  X(kPixy21I2c, "pixy2.1_i2c", kTwoWire, 0, 0x54, pixy2::kPixy21Profile)                                   \
  X(kCmucam1, "cmucam1", kLine, 115'200, 0, cmucam::nominal_intrinsics(cmucam::kCmuCam1, {}))              \
  X(kCmucam2, "cmucam2", kLine, 115'200, 0, cmucam::nominal_intrinsics(cmucam::kCmuCam2, {}))              \
  X(kCmucam3, "cmucam3", kLine, 115'200, 0, cmucam::nominal_intrinsics(cmucam::kCmuCam3, {}))              \
  X(kCmucam4, "cmucam4", kLine, 19'200, 0, cmucam::nominal_intrinsics(cmucam::kCmuCam4, {}))               \
  X(kHuskylens, "huskylens", kLine, 9'600, 0, huskylens::kProfile)                                         \
  X(kHuskylensI2c, "huskylens_i2c", kTwoWire, 0, 0x32, huskylens::kProfile)                                \
  X(kNxtcam, "nxtcam", kLine, 115'200, 0, nxtcam::kProfile)                                                \
  X(kNxtcamI2c, "nxtcam_i2c", kTwoWire, 0, 0x01, nxtcam::kProfile)                                         \
  X(kXbc, "xbc", kLine, 38'400, 0, xbc::nominal_intrinsics({}))                                            \
  X(kPixy1, "pixy1", kLine, 115'200, 0, pixy1::kProfile)                                                   \
  X(kPixy1I2c, "pixy1_i2c", kTwoWire, 0, 0x54, pixy1::kProfile)                                            \
  X(kCognachrome, "cognachrome", kLine, 38'400, 0, cognachrome::kProfile)                                  \
  X(kHuskylens2, "huskylens2", kLine, 115'200, 0, huskylens::kProfile2)                                    \
  X(kHuskylens2I2c, "huskylens2_i2c", kTwoWire, 0, 0x50, huskylens::kProfile2)                             \
  X(kJevois, "jevois", kLine, 115'200, 0, jevois::nominal_intrinsics({}))                                  \
  X(kGrove, "grove", kLine, 921'600, 0, grove::kProfile)                                                   \
  X(kGroveI2c, "grove_i2c", kTwoWire, 0, 0x62, grove::kProfile)
// clang-format on
