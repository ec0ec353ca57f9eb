// The floor that the robot is about to sweep, in whole millimetres: asked for each point of the guard.
#pragma once

#include <cstdint>

#include "firmware/alert/obstacle.hpp"

namespace fencepost::alert {

/// The strip of RobotPath, robot frame, along the ways that lead on.
class SweptArea {
 public:
  /// Narrower by `less` on either side (m), but never so narrow that it passes between two points of the guard.
  SweptArea(const RobotPath& path, float less);

  /// Is a place in it? At most 4 m away.
  [[nodiscard]] bool contains(std::int32_t x, std::int32_t y) const;

 private:
  Ways ways_;
  std::int32_t half_width_ = 0;
  std::int32_t twice_radius_ = 0;  ///< of the arc of the robot's origin, positive to the left
  std::int32_t inner_ = 0;         ///< mm^2: bounds of what is |place - pivot|^2 - radius^2 inside the strip
  std::int32_t outer_ = 0;
};

}  // namespace fencepost::alert
