// Odometry as the robot's wheels would report it: drift, and the per-view pose noise.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/sensor/odometry.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/trajectory.hpp"

namespace fencepost::host {

/// Odometry runs at 50 Hz.
inline constexpr base::Duration kOdometryPeriod = base::milliseconds(20);

/// Reports one sample each period from t = 0.
///
/// Drift: each step's true motion, measured along the path, is scaled by 1 + drift_scale and turned by drift_turn
/// (rad/m). It is also shifted by a gaussian of drift_walk (m/sqrt(m)) on each axis. Per-view noise: view i has one
/// offset (x, y, heading), which all samples hold whose nearest exposure is i. The pose at the exposure is interpolated
/// between two samples. It is off by exactly that offset if both belong to the view: for rates up to 25 /s, and for 50
/// /s. In between, some views blend with a neighbour's.
class Odometer {
 public:
  Odometer(const Scene& scene, const Trajectory& trajectory);

  /// The next sample, in order of time.
  sensor::OdometrySample next();

 private:
  void advance(const TimedPose& before, const TimedPose& now);
  [[nodiscard]] TimedPose with_view_offset(TimedPose pose) const;

  const Scene& scene_;
  const Trajectory& trajectory_;
  std::int64_t step_ = 0;
  bool drifts_ = false;  ///< has drifted: noise may begin while it drives
  TimedPose reported_;
  std::vector<TimedPose> offsets_;  ///< one a view; empty without per-view noise
};

}  // namespace fencepost::host
