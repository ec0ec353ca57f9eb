// Where the robot truly is at a time: the scene's path as a function.
#pragma once

#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::host {

/// world_T_robot over time, t in seconds from 0. Before its start and after its end the robot stands still.
class Trajectory {
 public:
  /// `scene.path` must not be empty.
  explicit Trajectory(const Scene& scene);

  [[nodiscard]] TimedPose at(double t) const;
  /// Seconds until the robot stands.
  [[nodiscard]] double duration() const { return duration_; }
  /// Camera frames: `views` of an arc, else one each 1/rate seconds from 0 up to and including the duration.
  [[nodiscard]] int frames() const { return frames_; }

 private:
  [[nodiscard]] TimedPose on_arc(const ArcPath& arc, double t) const;
  [[nodiscard]] TimedPose between_knots(double t) const;

  const Scene& scene_;
  std::vector<TimedPose> knots_;  ///< waypoints and poses; headings continuous
  double duration_ = 0;
  int frames_ = 0;
};

}  // namespace fencepost::host
