// "robot" of a scene or robot file: the robot's outline.
#pragma once

#include <optional>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// Robot frame, m: origin midway between the wheels, x forward, y left.
struct RobotBody {
  std::optional<double> front;  ///< from the origin
  std::optional<double> rear;
  std::optional<double> width;
  LinearRing footprint;  ///< in place of the three; empty if there is none
};

/// Whole hundredths of a metre, the decimals of the robot's settings.
struct BodyRectangle {
  int front = 0;
  int rear = 0;
  int width = 0;
};

/// The least that covers a footprint around the origin, as wide to the left as to the right.
BodyRectangle rectangle_around(const LinearRing& footprint);

}  // namespace fencepost::host
