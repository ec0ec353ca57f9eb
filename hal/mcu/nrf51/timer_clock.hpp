// The robot's clock: timer 0 counts microseconds, an interrupt a millisecond keeps what it cannot hold. The core of
// this family has no SysTick.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::mcu::nrf51 {

class TimerClock {
 public:
  void start();
  /// The timer's interrupt. May be late: the core stands still while flash is erased.
  void on_interrupt();

  /// Since start(). Not to be called from an interrupt.
  [[nodiscard]] base::Time now() const;
  /// The same, wraps after 71 minutes.
  [[nodiscard]] std::uint32_t microseconds() const;

 private:
  void count_milliseconds();

  volatile std::uint32_t low_ = 0;  ///< milliseconds
  volatile std::uint32_t high_ = 0;
  volatile std::uint32_t counted_ = 0;  ///< the timer, in microseconds, when they were over
};

static_assert(bus::Clock<TimerClock>);

}  // namespace fencepost::mcu::nrf51
