// Time on the bench: the wall's, or the board's own where an emulator runs as fast as it can.
#pragma once

#include <chrono>
#include <optional>

namespace fencepost::test {

/// A clock as std::chrono wants it. There is one bench at a time.
struct BenchClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<BenchClock>;
  static constexpr bool is_steady = true;

  static time_point now() {
    if (emulated) return time_point(*emulated);
    return time_point(std::chrono::steady_clock::now().time_since_epoch());
  }

  /// Set while a board is on the bench whose emulator tells its time.
  static inline std::optional<duration> emulated;
};

}  // namespace fencepost::test
