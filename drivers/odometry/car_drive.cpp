#include "drivers/odometry/car_drive.hpp"

#include <algorithm>

#include "drivers/odometry/tick_counter.hpp"
#include "drivers/odometry/wheel_base.hpp"
#include "hal/base/check.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::odometry {
namespace {

constexpr std::int64_t kMillion = 1'000'000;
// mm/s of the fastest car: more counts are a restart of the encoder.
constexpr std::int64_t kFastest = 5'000;
// Maximum time between two readings over which the car is assumed to move.
constexpr base::Duration kLongestStep{std::int64_t{10} * base::Duration::kPerUnit};
// The sharpest turn of the wheels that a tangent is taken of.
constexpr std::int64_t kSharpest = 1'300'000;  // urad
// Maximum spread of the rates of a stationary car: 2 deg/s, in 10^-4 rad/s.
constexpr std::int32_t kSteady = 349;
// Maximum bias of a gyro, in 10^-4 rad/s (MPU-6050: 20 deg/s by its data sheet).
constexpr std::int32_t kLargest = 3'491;
// Maximum change of a learnt bias: 3 deg/s, in 10^-4 rad/s. Warmth changes it less, a hand that turns the car more.
constexpr std::int32_t kChange = 524;
constexpr std::int32_t kReadings = 5;  // of a standstill, at least
constexpr int kLearning = 4;           // a new standstill counts for a quarter

std::int64_t clamp_turn(std::int64_t urad) { return std::clamp(urad, -kSharpest, kSharpest); }

// 2^20 tan of the wheels' angle, for a measured steering angle in 10^-4 rad.
std::int64_t tangent(std::int32_t told, const CarGeometry& car) {
  constexpr std::int64_t kMicroPerRaw = kMillion / base::Radians::kPerUnit;
  constexpr std::int64_t kThousand = 1'000;
  const std::int64_t straight = told * kMicroPerRaw - car.steer_offset_urad;
  const base::SinCos wheels = base::sincos_urad(clamp_turn(divide_nearest(straight * car.steer_scale, kThousand)));
  constexpr float kOne = 1 << 20;
  return static_cast<std::int64_t>(wheels.sin / wheels.cos * kOne);
}

}  // namespace

CarProblem problem_of(const sensor::CarSample& sample, const CarGeometry& car) {
  if (car.pm_per_count == 0) return CarProblem::kNoCounts;
  if (sample.yaw_rate) return CarProblem::kNone;
  if (!sample.steering) return CarProblem::kNoHeading;
  return car.wheelbase_um == 0 ? CarProblem::kNoWheelbase : CarProblem::kNone;
}

sensor::OdometrySample CarDrive::take(const sensor::CarSample& sample, const CarGeometry& car) {
  FENCEPOST_CHECK(problem_of(sample, car) == CarProblem::kNone);
  if (last_ && sample.t > last_->t) {
    const std::int64_t distance = distance_pm(sample, car);
    const bool by_gyro = sample.yaw_rate && last_->yaw_rate;
    const std::int64_t before = heading_prad_;
    heading_prad_ += by_gyro ? turn_by_gyro(sample, car) : turn_by_steering(sample, car, distance);
    watch_standing(sample, before);
    pose_.advance(distance, divide_nearest(heading_prad_, kMillion));
  }
  last_ = sample;
  return pose_.sample(sample.t);
}

std::int64_t CarDrive::distance_pm(const sensor::CarSample& sample, const CarGeometry& car) const {
  // Counts wrap; their difference does not.
  const auto counts =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(sample.count) - static_cast<std::uint32_t>(last_->count));
  const base::Duration passed = std::min(sample.t - last_->t, kLongestStep) + kLateness;
  const std::int64_t possible = kFastest * kPicometresPerMillimetre / base::Duration::kPerUnit * passed.raw;
  const std::int64_t way = car.pm_per_count < 0 ? -car.pm_per_count : car.pm_per_count;
  if (counts > possible / way || counts < -(possible / way)) return 0;
  return counts * car.pm_per_count;
}

std::int32_t CarDrive::bias(const CarGeometry& car) const {
  constexpr std::int64_t kMicroPerRaw = kMillion / base::RadiansPerSecond::kPerUnit;
  return bias_
             ? *bias_
             : static_cast<std::int32_t>(divide_nearest(std::int64_t{car.gyro_bias_urad_s} * kRateParts, kMicroPerRaw));
}

// The sum of both rates is twice their mean: parts of 10^-4 rad/s, 10^-4 s, 10^-4, twice.
std::int64_t CarDrive::turn_by_gyro(const sensor::CarSample& sample, const CarGeometry& car) const {
  const std::int64_t rates =
      (std::int64_t{sample.yaw_rate->raw} + last_->yaw_rate->raw) * kRateParts - 2 * std::int64_t{bias(car)};
  const base::Duration passed = std::min(sample.t - last_->t, kLongestStep);
  return divide_nearest(rates * passed.raw * car.gyro_scale, 2 * kRateParts);
}

std::int64_t CarDrive::turn_by_steering(const sensor::CarSample& sample, const CarGeometry& car,
                                        std::int64_t distance) const {
  const bool both = sample.steering && last_->steering && car.wheelbase_um > 0;
  if (!both) return 0;
  const std::int64_t mean = (tangent(sample.steering->raw, car) + tangent(last_->steering->raw, car)) / 2;
  // pm by um are urad; 2^20 of the tangent and 10^6 pm in a urad: 5^6 / 2^14.
  return divide_nearest(divide_nearest(distance * mean, car.wheelbase_um) * 15'625, 16'384);
}

void CarDrive::watch_standing(const sensor::CarSample& sample, std::int64_t heading_before) {
  if (sample.count != last_->count || !sample.yaw_rate) {
    still_.reset();
    return;
  }
  const std::int32_t rate = sample.yaw_rate->raw;
  if (!still_) still_ = Still{last_->t, heading_before, 0, 0, rate, rate};
  still_->sum += rate;
  ++still_->count;
  still_->least = std::min(still_->least, rate);
  still_->most = std::max(still_->most, rate);
  if (sample.t - still_->since < kStandstill || still_->count < kReadings) return;
  const auto mean = static_cast<std::int32_t>(divide_nearest(still_->sum * kRateParts, still_->count));
  const std::int32_t allowed = (bias_ ? kChange : kLargest) * kRateParts;
  const std::int32_t off = mean - bias_.value_or(0);
  if (still_->most - still_->least <= kSteady && off <= allowed && off >= -allowed) {
    bias_ = bias_ ? *bias_ + off / kLearning : mean;
    heading_prad_ = still_->heading_prad;
  }
  still_.reset();
}

std::optional<double> CarDrive::learnt_bias() const {
  if (!bias_) return std::nullopt;
  return static_cast<double>(*bias_) / (kRateParts * static_cast<double>(base::RadiansPerSecond::kPerUnit));
}

}  // namespace fencepost::odometry
