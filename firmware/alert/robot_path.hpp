// The robot's body and how it moves.
#pragma once

#include "firmware/recon/observe/pose_history.hpp"

namespace fencepost::alert {

/// How the robot went when it surely moved last. A robot that was ordered to stop may continue like that.
struct LastWay {
  bool back = false;
  bool turning = false;
  void follow(const recon::Motion& motion);
};

/// Robot frame: origin midway between the wheels, x forward, y left. An end with a configured length is straight, with
/// a corner on either side. An end without is a half circle of the body's width.
struct RobotPath {
  recon::Motion motion;
  float half_width = 0.15F;  ///< half the robot's width plus the margin, m
  float body_radius = 0.1F;  ///< half its width, m
  float front = 0;           ///< from the origin to the front's corners, m; 0: not configured
  float rear = 0;            ///< likewise, to the rear's
  LastWay last;              ///< counts for a body with corners

  [[nodiscard]] bool has_corners() const { return front > 0 || rear > 0; }
};

/// The ways that lead on from here, by the robot's motion.
struct Ways {
  explicit Ways(const RobotPath& path);
  bool ahead = true;
  bool behind = false;
  bool straight = true;
  bool arc = false;
  bool spins = false;  ///< on the spot or nearly so
  float radius = 0;    ///< m, of an arc or a spin, positive to the left
};

}  // namespace fencepost::alert
