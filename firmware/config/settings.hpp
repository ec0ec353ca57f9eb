// The settings of one robot: names, units, defaults and ranges in one table; `set`, `get`, `help` and FPCFG all read
// it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/sensor/camera.hpp"

namespace fencepost::config {

enum class Key : std::uint8_t {
  kAlertStop,
  kAlertWarn,
  kAlertNotice,
  kAlertTtcStop,
  kAlertTtcWarn,
  kRobotFront,
  kRobotRear,
  kRobotWidth,
  kRobotMargin,
  kConfirmK,
  kConfirmN,
  kAlertRate,
  kCameraNoise,
  kCorrectDrift,
  kCorrectPose,
  kCarCounts,
  kCarWheelbase,
  kSteerScale,
  kSteerOffset,
  kGyroScale,
  kGyroBias,
};
inline constexpr std::size_t kKeys = 21;

/// Values of `correct.pose` by their counts, and its unit.
enum Correct : std::int32_t { kCorrectOff, kCorrectOn, kCorrectAuto };
inline constexpr std::string_view kChoice = "off|on|auto";

struct KeyInfo {
  std::string_view name;
  std::string_view unit;      ///< kChoice: one of those words
  std::int32_t decimals = 0;  ///< values are counts of 10^-decimals
  std::int32_t initial = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::string_view help;
};

/// By Key.
inline constexpr std::array<KeyInfo, kKeys> kKeyInfo = {{
    {"alert.stop", "m", 2, 25, 0, 1000, "in the path and this near: stop"},
    {"alert.warn", "m", 2, 50, 0, 1000, "in the path and this near: warn"},
    {"alert.notice", "m", 2, 100, 0, 1000, "in the path and this near: notice"},
    {"alert.ttc_stop", "s", 1, 8, 0, 600, "in the path and this soon: stop"},
    {"alert.ttc_warn", "s", 1, 20, 0, 600, "in the path and this soon: warn"},
    {"robot.front", "m", 2, 0, 0, 500, "to the front edge; 0: half the width"},
    {"robot.rear", "m", 2, 0, 0, 500, "to the rear edge; 0: half the width"},
    {"robot.width", "m", 2, 20, 2, 500, "across the wheels"},
    {"robot.margin", "m", 2, 5, 0, 500, "kept free on either side"},
    {"confirm.k", "", 0, 3, 1, 16, "sightings that confirm an object"},
    {"confirm.n", "", 0, 5, 1, 16, "among this many frames"},
    {"alert.rate", "/s", 0, 5, 1, 50, "repeated alerts of one object"},
    {"camera.noise", "px", 2, 0, 0, 1000, "sigma of a box edge; 0: by its columns"},
    {"correct.drift", "%", 1, 30, 1, 500, "of the distance: how far off odometry is"},
    {"correct.pose", kChoice, 0, kCorrectAuto, 0, kCorrectAuto, "by landmarks seen again; auto: if odometry drifts"},
    {"car.counts", "/m", 1, 0, -10'000'000, 10'000'000, "of a car's encoder; 0: not configured; negative: backwards"},
    {"car.wheelbase", "m", 3, 0, 0, 3'000, "between its axles; 0: not configured"},
    {"steer.scale", "", 3, 1'000, -10'000, 10'000,
     "turn of the wheels over the reported one; negative: right is positive"},
    {"steer.offset", "deg", 2, 0, -4'500, 4'500, "reported when it goes straight"},
    {"gyro.scale", "", 4, 10'000, -20'000, 20'000, "true turn for one measured; negative: clockwise is positive"},
    {"gyro.bias", "deg/s", 3, 0, -30'000, 30'000, "measured when nothing turns, until it has stood"},
}};

constexpr const KeyInfo& info(Key key) { return kKeyInfo[static_cast<std::size_t>(key)]; }

/// Why a setting was not taken.
enum class SettingError : std::uint8_t { kUnknownKey, kNotANumber, kOutOfRange };

class Settings {
 public:
  constexpr Settings() {
    for (std::size_t i = 0; i < kKeys; ++i) values_[i] = kKeyInfo[i].initial;
  }

  /// Count of 10^-decimals units.
  [[nodiscard]] constexpr std::int32_t raw(Key key) const { return values_[static_cast<std::size_t>(key)]; }
  /// In the key's unit.
  [[nodiscard]] float number(Key key) const;

  /// Takes `value` as written on the console. Nothing changes on an error.
  std::optional<SettingError> set(std::string_view key, std::string_view value);
  /// As FPCFG and `get` write it: exactly the key's decimals, or the word.
  [[nodiscard]] sensor::Text text(Key key) const;

  friend constexpr bool operator==(const Settings&, const Settings&) = default;

 private:
  std::array<std::int32_t, kKeys> values_{};
};

}  // namespace fencepost::config
