// Where the robot believes it is.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/base/units.hpp"

namespace fencepost::sensor {

/// Integrated pose world_T_robot: origin midway between the wheels on the floor, x forward, y left.
/// Heading counter-clockwise from the world's x; wrapped or continuous, both are accepted.
struct OdometrySample {
  base::Time t;
  base::Metres x;
  base::Metres y;
  base::Radians heading;
  friend constexpr bool operator==(const OdometrySample&, const OdometrySample&) = default;
};

/// Readings of a car with one encoder on its unsteered axle, and a steering angle or a gyro: no pose yet.
struct CarSample {
  base::Time t;
  std::int32_t count = 0;                          ///< of the encoder, raw; wraps at 32 bits
  std::optional<base::Radians> steering;           ///< as it was reported, left positive
  std::optional<base::RadiansPerSecond> yaw_rate;  ///< as the gyro measures it, counter-clockwise positive
  friend constexpr bool operator==(const CarSample&, const CarSample&) = default;
};

}  // namespace fencepost::sensor
