// The geometry of a wheel base with two driven wheels: what turns encoder counts into a path.
#pragma once

#include <cstdint>

namespace fencepost::odometry {

/// Picometres keep a step of any encoder exact to 1e-6 and 9000 km of driving inside 64 bits.
inline constexpr std::int64_t kPicometresPerMillimetre = 1'000'000'000;

/// A wheel and its encoder as their data sheets describe them.
struct WheelDrawing {
  double wheel_diameter_mm = 0;
  double counts_per_revolution =
      0;  ///< of the wheel, gearing and quadrature included; negative where forward counts down
};

constexpr std::int64_t to_picometres(double millimetres) {
  const double scaled = millimetres * static_cast<double>(kPicometresPerMillimetre);
  return static_cast<std::int64_t>(scaled + (scaled < 0 ? -0.5 : 0.5));
}

/// Distance along the wheel's rim per count, pm.
constexpr std::int64_t per_count(const WheelDrawing& wheel) {
  constexpr double kPiExact = 3.14159265358979323846;
  return to_picometres(kPiExact * wheel.wheel_diameter_mm / wheel.counts_per_revolution);
}

/// Left and right separately, since wheels are never exactly equal (UMBmark, Borenstein and Feng 1996, gives the
/// figures). The zeros here are invalid: a wheel base has non-zero distances per count and a positive track.
struct WheelBase {
  std::int64_t left_pm_per_count = 0;
  std::int64_t right_pm_per_count = 0;
  std::int64_t track_pm = 0;            ///< distance of the wheels' contact points, at most 9 m
  int counter_bits = 32;                ///< at which the raw counts wrap, 2..32
  std::int32_t max_speed_mm_s = 2'000;  ///< of a wheel; faster counts mean that a counter was reset
};

constexpr WheelBase make_wheel_base(const WheelDrawing& wheel, double track_mm, int counter_bits,
                                    std::int32_t max_speed_mm_s = 2'000) {
  return {per_count(wheel), per_count(wheel), to_picometres(track_mm), counter_bits, max_speed_mm_s};
}

/// iRobot Create 2, Roomba 600: 508.8 counts a revolution, wheel 72 mm, axle 235 mm (Open Interface specification). The
/// maximum speed is 500 mm/s plus an allowance for a slope.
inline constexpr WheelBase kCreate2Wheels = make_wheel_base({72.0, 508.8}, 235.0, 16, 600);

/// iRobot Create 1: axle 258 mm (its manual's figure); it reports no counts.
inline constexpr WheelBase kCreate1Wheels = make_wheel_base({72.0, 508.8}, 258.0, 16, 600);

}  // namespace fencepost::odometry
