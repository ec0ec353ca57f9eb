// Where the robot truly is at a time: the scene's path as a function.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::host {

/// Between the poses: straight, and the short way round. Before the first it is the first, after the last the last.
/// `knots`: not empty, as `continuous` gives them.
TimedPose pose_between(std::span<const TimedPose> knots, double t);
/// The same poses, no heading farther than half a turn from the one before.
std::vector<TimedPose> continuous(std::vector<TimedPose> poses);

/// world_T_robot over time, t in seconds from 0. Before its start and after its end the robot is stationary.
class Trajectory {
 public:
  /// `scene.path` must not be empty.
  explicit Trajectory(const Scene& scene);
  /// Whoever drives says where the robot is at t.
  Trajectory(const Scene& scene, std::function<TimedPose(double t)> driver, double duration);

  [[nodiscard]] TimedPose at(double t) const;
  /// Seconds until the robot stops.
  [[nodiscard]] double duration() const { return duration_; }
  /// Camera frames: `views` of an arc, else one each 1/rate seconds from 0 up to and including the duration.
  [[nodiscard]] int frames() const { return frames_; }

 private:
  [[nodiscard]] TimedPose on_arc(const ArcPath& arc, double t) const;

  const Scene& scene_;
  std::function<TimedPose(double)> driver_;
  std::vector<TimedPose> knots_;  ///< waypoints and poses; headings continuous
  double duration_ = 0;
  int frames_ = 0;
};

}  // namespace fencepost::host
