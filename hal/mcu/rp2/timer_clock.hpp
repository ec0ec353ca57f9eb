// The robot's clock out of the part's timer: microseconds in 64 bits, and an interrupt a millisecond to wake the loop.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::mcu::rp2 {

class TimerClock {
 public:
  /// `reference_hz`: of the clock that is divided down to microseconds.
  static void start(std::uint32_t reference_hz);
  /// The timer's interrupt 0.
  static void tick();

  /// Since the part was started.
  [[nodiscard]] static base::Time now();
  /// The same, wraps after 71 minutes.
  [[nodiscard]] static std::uint32_t microseconds();
};

static_assert(bus::Clock<TimerClock>);

}  // namespace fencepost::mcu::rp2
