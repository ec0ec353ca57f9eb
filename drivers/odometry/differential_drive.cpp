#include "drivers/odometry/differential_drive.hpp"

#include "hal/base/check.hpp"

namespace fencepost::odometry {
namespace {

std::int64_t counts_a_second(const WheelBase& wheels, std::int64_t pm_per_count) {
  FENCEPOST_CHECK(pm_per_count != 0 && wheels.track_pm > 0);
  const std::int64_t way = pm_per_count < 0 ? -pm_per_count : pm_per_count;
  return wheels.max_speed_mm_s * kPicometresPerMillimetre / way + 1;
}

// Whole radians apart from the rest: the product of the sum with 1e6 would not fit.
std::int64_t angle_urad(std::int64_t arc_pm, std::int64_t radius_pm) {
  constexpr std::int64_t kMicro = 1'000'000;
  return arc_pm / radius_pm * kMicro + divide_nearest(arc_pm % radius_pm * kMicro, radius_pm);
}

}  // namespace

DifferentialDrive::DifferentialDrive(const WheelBase& wheels)
    : wheels_(wheels),
      left_(wheels.counter_bits, counts_a_second(wheels, wheels.left_pm_per_count)),
      right_(wheels.counter_bits, counts_a_second(wheels, wheels.right_pm_per_count)) {}

sensor::OdometrySample DifferentialDrive::take(std::uint32_t left, std::uint32_t right, base::Time t) {
  const std::optional<std::int32_t> left_counts = left_.step(left, t);
  const std::optional<std::int32_t> right_counts = right_.step(right, t);
  // One wheel alone would be a turn that never took place.
  if (left_counts && right_counts) {
    move(*left_counts, *right_counts);
  } else if (started_) {
    ++resets_;
  }
  started_ = true;
  return pose_.sample(t);
}

void DifferentialDrive::forget_counts() {
  left_.forget();
  right_.forget();
  started_ = false;
}

void DifferentialDrive::move(std::int32_t left_counts, std::int32_t right_counts) {
  const std::int64_t left_pm = left_counts * wheels_.left_pm_per_count;
  const std::int64_t right_pm = right_counts * wheels_.right_pm_per_count;
  right_minus_left_pm_ += right_pm - left_pm;
  pose_.advance((left_pm + right_pm) / 2, angle_urad(right_minus_left_pm_, wheels_.track_pm));
}

}  // namespace fencepost::odometry
