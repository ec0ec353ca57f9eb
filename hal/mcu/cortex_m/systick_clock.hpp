// The robot's clock out of the core's own timer: an interrupt a millisecond, the counter between them.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::mcu::cortex_m {

class SysTickClock {
 public:
  /// `core_hz`: what the core runs at, in fact.
  void start(std::uint32_t core_hz);
  /// The SysTick interrupt.
  void tick();

  /// Since start(). Not to be called from an interrupt.
  [[nodiscard]] base::Time now() const;
  /// The same, wraps after 71 minutes.
  [[nodiscard]] std::uint32_t microseconds() const;

 private:
  struct Reading {
    std::uint64_t milliseconds;
    std::uint32_t cycles;  ///< of the core since then
  };
  [[nodiscard]] Reading read() const;

  volatile std::uint32_t low_ = 0;  ///< milliseconds
  volatile std::uint32_t high_ = 0;
  std::uint32_t cycles_ = 1;  ///< of the core a millisecond
};

static_assert(bus::Clock<SysTickClock>);

}  // namespace fencepost::mcu::cortex_m
