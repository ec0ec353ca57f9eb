#include "host/simulate/car_odometer.hpp"

#include <cmath>

#include "host/simulate/odometer.hpp"
#include "host/simulate/random.hpp"

namespace fencepost::host {

sensor::CarSample CarOdometer::next() {
  const base::Time t{step_ * kOdometryPeriod.raw};
  const double period = kOdometryPeriod.to_double();
  const double now = t.to_double();
  if (step_ > 0) driven_ += motion(now - period, now).way * (1 + scene_.noise.drift_scale);
  const Motion around = motion(now - period / 2, now + period / 2);
  sensor::CarSample sample;
  sample.t = t;
  sample.count = static_cast<std::int32_t>(std::floor(driven_ * scene_.odometry.counts));
  if (scene_.odometry.kind == SceneOdometry::Kind::kGyro) {
    sample.yaw_rate = base::RadiansPerSecond::nearest(rate(around));
  } else {
    sample.steering = base::Radians::nearest(told(around));
  }
  ++step_;
  return sample;
}

CarOdometer::Motion CarOdometer::motion(double from, double to) const {
  constexpr double kStraight = 1e-6;  // rad
  const TimedPose a = trajectory_.at(from);
  const TimedPose b = trajectory_.at(to);
  const double turn = b.heading - a.heading;
  const double middle = a.heading + turn / 2;
  const double chord = (b.x - a.x) * std::cos(middle) + (b.y - a.y) * std::sin(middle);
  return {std::abs(turn) < kStraight ? chord : chord * (turn / 2) / std::sin(turn / 2), turn};
}

double CarOdometer::rate(const Motion& around) {
  const SceneNoise& noise = scene_.noise;
  const double period = kOdometryPeriod.to_double();
  Random random(scene_.seed, Purpose::kCarReading, static_cast<std::uint64_t>(step_));
  if (step_ > 0) walked_ += noise.gyro_walk * std::sqrt(period) * random.gaussian();
  return around.turn / period * (1 + noise.gyro_scale) + noise.gyro_bias + walked_ +
         noise.gyro_noise * random.gaussian();
}

double CarOdometer::told(const Motion& around) {
  constexpr double kMoves = 1e-9;
  constexpr double kTurns = 1e-6;  // rad: less is rounding of the path
  const SceneNoise& noise = scene_.noise;
  // While it is stationary, the wheels stay as they are.
  if (std::abs(around.way) > kMoves) {
    const double wheels = std::atan(scene_.odometry.wheelbase * around.turn / around.way);
    if (std::abs(wheels - wheels_) > kTurns) side_ = wheels > wheels_ ? 1 : -1;
    wheels_ = wheels;
  }
  return wheels_ / (1 + noise.steer_scale) + noise.steer_offset + side_ * noise.steer_backlash / 2;
}

}  // namespace fencepost::host
