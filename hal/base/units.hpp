// Strong units. Quantities that cross an interface are scaled integers with exactly the decimals of their record field.
// So a value that the log cannot express cannot exist in the loop. This is what makes replay exact.
#pragma once

#include <compare>
#include <cstdint>

namespace fencepost::base {

/// 10^n for small n.
constexpr std::int64_t power_of_ten(int n) {
  std::int64_t value = 1;
  for (int i = 0; i < n; ++i) value *= 10;
  return value;
}

/// A quantity in `Unit`, held as an integer count of 10^-Decimals units.
template <class Unit, int Decimals, class Rep = std::int32_t>
struct Scaled {
  using rep = Rep;
  static constexpr int kDecimals = Decimals;
  static constexpr Rep kPerUnit = static_cast<Rep>(power_of_ten(Decimals));

  Rep raw{};

  /// Nearest representable value, half away from zero. The caller keeps `value` inside the range of Rep.
  static constexpr Scaled nearest(double value) {
    const double scaled = value * static_cast<double>(kPerUnit);
    const auto whole = static_cast<Rep>(scaled);
    // The remainder is exact; adding 0.5 before truncating would not be, just below a half.
    const double rest = scaled - static_cast<double>(whole);
    return {static_cast<Rep>(whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0))};
  }
  /// Correctly rounded for |raw| < 2^24, else the nearest float of raw divided once.
  [[nodiscard]] constexpr float to_float() const { return static_cast<float>(raw) / static_cast<float>(kPerUnit); }
  [[nodiscard]] constexpr double to_double() const { return static_cast<double>(raw) / static_cast<double>(kPerUnit); }

  friend constexpr auto operator<=>(Scaled, Scaled) = default;
  friend constexpr Scaled operator+(Scaled a, Scaled b) { return {static_cast<Rep>(a.raw + b.raw)}; }
  friend constexpr Scaled operator-(Scaled a, Scaled b) { return {static_cast<Rep>(a.raw - b.raw)}; }
  friend constexpr Scaled operator-(Scaled a) { return {static_cast<Rep>(-a.raw)}; }
};

struct MetreUnit;
struct RadianUnit;
struct PixelUnit;
struct AngularRateUnit;
struct RatioUnit;
struct SecondUnit;
struct ClockUnit;

using Metres = Scaled<MetreUnit, 4>;                  ///< 0.1 mm
using Radians = Scaled<RadianUnit, 4>;                ///< 0.1 mrad, counter-clockwise positive
using RadiansPerSecond = Scaled<AngularRateUnit, 4>;  ///< counter-clockwise positive
using Pixels1 = Scaled<PixelUnit, 1>;                 ///< centroids
using Pixels2 = Scaled<PixelUnit, 2>;                 ///< focal lengths and principal points
using Ratio2 = Scaled<RatioUnit, 2>;                  ///< confidences
using Ratio4 = Scaled<RatioUnit, 4>;                  ///< distortion coefficients
using Duration = Scaled<SecondUnit, 4, std::int64_t>;

/// The robot's clock: a count of 0.1 ms since its own zero. A point, not a length: only differences are durations.
struct Time {
  using rep = std::int64_t;
  static constexpr int kDecimals = 4;
  static constexpr std::int64_t kPerUnit = 10'000;

  std::int64_t raw{};

  static constexpr Time nearest(double seconds) { return {Duration::nearest(seconds).raw}; }
  [[nodiscard]] constexpr double to_double() const { return static_cast<double>(raw) / static_cast<double>(kPerUnit); }

  friend constexpr auto operator<=>(Time, Time) = default;
  friend constexpr Duration operator-(Time a, Time b) { return {a.raw - b.raw}; }
  friend constexpr Time operator+(Time a, Duration d) { return {a.raw + d.raw}; }
  friend constexpr Time operator-(Time a, Duration d) { return {a.raw - d.raw}; }
};

/// Whole milliseconds as a duration.
constexpr Duration milliseconds(std::int64_t ms) { return {ms * 10}; }

}  // namespace fencepost::base
