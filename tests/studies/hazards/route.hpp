// The way a robot means to drive: legs of constant speed and turn rate.
#pragma once

#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::test {

struct Leg {
  double seconds = 0;
  double speed = 0;      ///< m/s, negative: backwards
  double turn_rate = 0;  ///< rad/s, positive: to the left
};

/// world_T_robot by progress (s): the time that the drive would take if nothing held the robot up. The last leg goes on
/// for ever; no leg: the robot stands.
class Route {
 public:
  Route() = default;
  Route(host::TimedPose start, std::vector<Leg> legs);

  [[nodiscard]] host::TimedPose at(double progress) const;
  /// m/s, without its sign
  [[nodiscard]] double speed(double progress) const;
  /// Until the last leg begins, s.
  [[nodiscard]] double last_leg() const { return begins_.empty() ? 0 : begins_.back().t; }

 private:
  [[nodiscard]] std::size_t leg_at(double progress) const;

  std::vector<Leg> legs_;
  std::vector<host::TimedPose> begins_;  ///< of each leg
  host::TimedPose start_;
};

/// In the frame of `base`: so far ahead, so far to the left, turned by `turn`.
host::TimedPose relative(const host::TimedPose& base, double ahead, double left, double turn = 0);

}  // namespace fencepost::test
