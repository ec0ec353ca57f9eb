// The wheels of one robot, for encoders on the board's own pins. Change these three numbers for yours.
#pragma once

#include "drivers/odometry/wheel_base.hpp"

namespace fencepost::config {

inline constexpr double kWheelDiameterMm = 65.0;  ///< the yellow wheel of school kits
inline constexpr double kCountsPerRevolution =
    1'440.0;                               ///< of the wheel, four an encoder's period; negative: backwards
inline constexpr double kTrackMm = 130.0;  ///< between the wheels' middles
inline constexpr int kCounterBits = 16;    ///< boards count modulo 2^16

inline constexpr odometry::WheelBase kWheels =
    odometry::make_wheel_base({kWheelDiameterMm, kCountsPerRevolution}, kTrackMm, kCounterBits);

}  // namespace fencepost::config
