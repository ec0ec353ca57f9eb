// Where the robot believes it is.
#pragma once

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

}  // namespace fencepost::sensor
