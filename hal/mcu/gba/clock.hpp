// The robot's clock: two timers in a row, 32 bits at 262144 Hz, and an interrupt that keeps the rest.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::mcu::gba {

class Clock {
 public:
  /// Ticks a second: often enough for a UART at 115200 baud that holds four bytes.
  static constexpr std::uint32_t kTicks = 4096;

  /// Also starts the interrupt of timer 2, kTicks a second.
  void start();
  /// That interrupt.
  void tick();

  /// Since start(). Not to be called from an interrupt.
  [[nodiscard]] base::Time now() const;
  /// The same, wraps after 71 minutes; in steps of 4.
  [[nodiscard]] std::uint32_t microseconds() const;
  /// Whole milliseconds (of 1/1024 s) as the interrupt counts them; wraps.
  [[nodiscard]] std::uint32_t milliseconds() const { return ticks_ / (kTicks / 1024); }

 private:
  [[nodiscard]] std::uint64_t counts() const;

  volatile std::uint32_t low_ = 0;  ///< the counter, as it was at the last tick
  volatile std::uint32_t high_ = 0;
  volatile std::uint32_t ticks_ = 0;
};

static_assert(bus::Clock<Clock>);

}  // namespace fencepost::mcu::gba
