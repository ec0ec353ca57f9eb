// Turns the readings of a car, one encoder and a gyro or a steering angle, into a pose.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/odometry/arc_integrator.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::odometry {

/// One car, in integers. Zero where it was not configured.
struct CarGeometry {
  std::int64_t pm_per_count = 0;  ///< of the middle of the unsteered axle; negative: counts down when driving forward
  std::int64_t wheelbase_um = 0;  ///< between the axles, 10 mm .. 3 m
  std::int32_t steer_scale = 1'000;    ///< thousandths: turn of the front wheels for a measured one
  std::int32_t steer_offset_urad = 0;  ///< measured when it goes straight
  std::int32_t gyro_scale = 10'000;    ///< 10^-4: true turn for one measured
  std::int32_t gyro_bias_urad_s = 0;   ///< measured when nothing turns; in force until the car has stood
};

/// Why a reading cannot be used.
enum class CarProblem : std::uint8_t { kNone, kNoCounts, kNoHeading, kNoWheelbase };

CarProblem problem_of(const sensor::CarSample& sample, const CarGeometry& car);

/// world_T_robot of a car. Its origin is on the floor, midway between the wheels of the axle that is not steered. That
/// axle does not slip sideways: every motion is an arc about a point on its line. The heading is the gyro's where there
/// is one. Otherwise the bicycle model turns by tan(wheels) / wheelbase a metre (Siegwart and Nourbakhsh, Autonomous
/// Mobile Robots, section 3.2). Rates and angles between two readings are the mean of both.
///
/// A car is stationary when its encoder is still for kStandstill, at a rate that is steady and small. Then the rate is
/// the gyro's bias, learnt from there on. The heading goes back to the one at which the car stopped.
class CarDrive {
 public:
  /// The pose at the reading's time, in which the first one is the origin; t increases. Needs a reading without a
  /// problem. A count that no car can have moved in that time is a restart of the encoder: nothing has moved.
  sensor::OdometrySample take(const sensor::CarSample& sample, const CarGeometry& car);

  /// rad/s; empty until it has stood for the first time.
  [[nodiscard]] std::optional<double> learnt_bias() const;

  static constexpr base::Duration kStandstill = base::milliseconds(500);

 private:
  /// Rates and the bias in 1/256 of what the stream carries: a mean is finer than its readings.
  static constexpr std::int32_t kRateParts = 256;

  struct Still {
    base::Time since;
    std::int64_t heading_prad = 0;  ///< at the start
    std::int64_t sum = 0;           ///< of the rates, raw
    std::int32_t count = 0;
    std::int32_t least = 0;
    std::int32_t most = 0;
  };

  [[nodiscard]] std::int64_t distance_pm(const sensor::CarSample& sample, const CarGeometry& car) const;
  [[nodiscard]] std::int64_t turn_by_gyro(const sensor::CarSample& sample, const CarGeometry& car) const;
  [[nodiscard]] std::int64_t turn_by_steering(const sensor::CarSample& sample, const CarGeometry& car,
                                              std::int64_t distance) const;
  [[nodiscard]] std::int32_t bias(const CarGeometry& car) const;
  void watch_standing(const sensor::CarSample& sample, std::int64_t heading_before);

  std::optional<sensor::CarSample> last_;
  std::optional<Still> still_;
  std::optional<std::int32_t> bias_;  ///< kRateParts
  std::int64_t heading_prad_ = 0;
  ArcIntegrator pose_;
};

}  // namespace fencepost::odometry
