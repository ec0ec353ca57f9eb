// The readings of a car: one encoder, and a gyro or a steering angle, each with its errors.
#pragma once

#include <cstdint>

#include "hal/sensor/odometry.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/trajectory.hpp"

namespace fencepost::host {

/// One reading each kOdometryPeriod from t = 0. Whole counts of the way of the path, scaled by 1 + drift_scale.
///
/// Gyro: the mean rate of the 20 ms around the reading, times 1 + gyro_scale, plus gyro_bias, plus white gyro_noise
/// (rad/s). The bias walks by gyro_walk (rad/s per root of a second).
///
/// Steering angle: the reported command is the one that makes the front wheels turn as the path does. The wheels get 1
/// + steer_scale times the command, less steer_offset and the play of steer_backlash.
class CarOdometer {
 public:
  CarOdometer(const Scene& scene, const Trajectory& trajectory) : scene_(scene), trajectory_(trajectory) {}

  sensor::CarSample next();

 private:
  /// Way and turn between two times; the way is that of an arc, backwards negative.
  struct Motion {
    double way = 0;
    double turn = 0;
  };
  [[nodiscard]] Motion motion(double from, double to) const;
  [[nodiscard]] double rate(const Motion& around);
  [[nodiscard]] double told(const Motion& around);

  const Scene& scene_;
  const Trajectory& trajectory_;
  std::int64_t step_ = 0;
  double driven_ = 0;
  double walked_ = 0;  ///< of the gyro's bias
  double wheels_ = 0;  ///< rad, of the front wheels
  double side_ = 0;    ///< of the play, on which the steering pushes: +-1
};

}  // namespace fencepost::host
