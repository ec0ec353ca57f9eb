// The robot's clock out of timer 2, which counts microseconds in 32 bits whatever the core does. The core stops while
// the flash is erased, and interrupts that count milliseconds would be missed.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::mcu::stm32f4 {

class TimerClock {
 public:
  /// `timer_hz`: the clock of timers on APB1.
  void start(std::uint32_t timer_hz);

  /// Since start(). Called at least once in 71 minutes, when the counter wraps; not from an interrupt.
  [[nodiscard]] base::Time now() const;
  /// The same, wraps after 71 minutes.
  [[nodiscard]] static std::uint32_t microseconds();

 private:
  // Found by reading the counter; no state of the clock.
  mutable std::uint32_t low_ = 0;
  mutable std::uint32_t high_ = 0;
};

static_assert(bus::Clock<TimerClock>);

}  // namespace fencepost::mcu::stm32f4
