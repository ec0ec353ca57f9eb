// The wheels of one robot, for encoders on the board's own pins. Change these three numbers for yours, or configure
// with FENCEPOST_WHEELS.
#pragma once

#include "drivers/odometry/wheel_base.hpp"

namespace fencepost::config {

#ifndef FENCEPOST_WHEELS
#define FENCEPOST_WHEELS 65.0, 1'440.0, 130.0  // the yellow wheels of school kits
#endif

struct WheelNumbers {
  double diameter_mm;
  double counts_per_revolution;  ///< of the wheel, four an encoder's period; negative: backwards
  double track_mm;               ///< between the wheels' middles
};
inline constexpr WheelNumbers kWheelNumbers = {FENCEPOST_WHEELS};
inline constexpr int kCounterBits = 16;  ///< boards count modulo 2^16

inline constexpr odometry::WheelBase kWheels = odometry::make_wheel_base(
    {kWheelNumbers.diameter_mm, kWheelNumbers.counts_per_revolution}, kWheelNumbers.track_mm, kCounterBits);

}  // namespace fencepost::config
