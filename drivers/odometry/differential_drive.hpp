// Turns the counters of two wheels into a pose.
#pragma once

#include <cstdint>

#include "drivers/odometry/arc_integrator.hpp"
#include "drivers/odometry/tick_counter.hpp"
#include "drivers/odometry/wheel_base.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::odometry {

/// Fed with raw counts as they arrive. A short gap costs nothing: the counts of both wheels over it are one arc.
class DifferentialDrive {
 public:
  explicit DifferentialDrive(const WheelBase& wheels);

  /// The pose at `t`, when these counts were true; t increases. Counts as the device sends them, sign or none.
  sensor::OdometrySample take(std::uint32_t left, std::uint32_t right, base::Time t);

  /// The device has restarted and so have its counts: the pose stays, the next counts are the new reference.
  void forget_counts();

  /// How often counts were impossible as a motion and were taken as a restart, the first reading not counted.
  [[nodiscard]] std::uint32_t resets() const { return resets_; }

 private:
  void move(std::int32_t left_counts, std::int32_t right_counts);

  WheelBase wheels_;
  TickCounter left_;
  TickCounter right_;
  bool started_ = false;
  std::int64_t right_minus_left_pm_ = 0;
  ArcIntegrator pose_;
  std::uint32_t resets_ = 0;
};

}  // namespace fencepost::odometry
