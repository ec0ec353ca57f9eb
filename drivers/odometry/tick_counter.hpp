// Counts since the last reading from a raw encoder count that wraps or restarts.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/base/units.hpp"

namespace fencepost::odometry {

/// Latest delay of a reading: two readings may then lie closer in time than their counts.
inline constexpr base::Duration kLateness = base::milliseconds(100);

class TickCounter {
 public:
  /// `bits` 2..32: the raw count is modulo 2^bits, signed or not. `max_rate`: counts a second that the wheel can do.
  TickCounter(int bits, std::int64_t max_rate);

  /// Counts since the last reading, wrap taken out; t increases.
  /// errors: empty if unknown: the first reading, more counts than the wheel can do (an encoder reset), or a silence
  /// long enough to wrap. The next reading then counts from this one.
  std::optional<std::int32_t> step(std::uint32_t raw, base::Time t);

  /// The device has restarted: the next reading is a first one.
  void forget() { known_ = false; }

 private:
  [[nodiscard]] std::int32_t difference(std::uint32_t raw) const;

  int bits_;
  std::int64_t max_rate_;
  bool known_ = false;
  std::uint32_t last_ = 0;
  base::Time last_t_;
};

}  // namespace fencepost::odometry
