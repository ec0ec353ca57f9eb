#include "firmware/config/car.hpp"

#include "drivers/odometry/wheel_base.hpp"

namespace fencepost::config {

odometry::CarGeometry car_of(const Settings& settings) {
  // Tenths of a count a metre, thousandths of a metre, hundredths and thousandths of a degree.
  constexpr std::int64_t kPicometresOfTenths = 10'000 * odometry::kPicometresPerMillimetre;
  constexpr std::int64_t kMicroradians = 174'533;  // of ten degrees
  odometry::CarGeometry car;
  const std::int64_t counts = settings.raw(Key::kCarCounts);
  if (counts != 0) car.pm_per_count = kPicometresOfTenths / counts;
  car.wheelbase_um = std::int64_t{1'000} * settings.raw(Key::kCarWheelbase);
  car.steer_scale = settings.raw(Key::kSteerScale);
  car.steer_offset_urad =
      static_cast<std::int32_t>(odometry::divide_nearest(kMicroradians * settings.raw(Key::kSteerOffset), 1'000));
  car.gyro_scale = settings.raw(Key::kGyroScale);
  car.gyro_bias_urad_s =
      static_cast<std::int32_t>(odometry::divide_nearest(kMicroradians * settings.raw(Key::kGyroBias), 10'000));
  return car;
}

std::string_view reason(odometry::CarProblem problem) {
  switch (problem) {
    case odometry::CarProblem::kNone: return {};
    case odometry::CarProblem::kNoCounts:
      return "car.counts is not set: drive a metre, then 'set car.counts' to what the encoder counted";
    case odometry::CarProblem::kNoHeading:
      return "it has no yaw rate and no steering angle: an encoder alone knows no heading; send one of the two";
    case odometry::CarProblem::kNoWheelbase:
      return "a steering angle needs the wheelbase: 'set car.wheelbase' to the metres between the axles, or send a yaw "
             "rate";
  }
  return {};
}

}  // namespace fencepost::config
