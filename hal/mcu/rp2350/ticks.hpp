// The microseconds of the timer and the watchdog.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2350/registers.hpp"

namespace fencepost::mcu::rp2350 {

/// Microseconds out of the reference clock: a generator for each (8.5.1).
inline void start_microseconds(std::uint32_t reference_hz) {
  reg(kTimerTickCycles) = reference_hz / 1'000'000;
  reg(kTimerTickControl) = kTickEnable;
  reg(kWatchdogTickCycles) = reference_hz / 1'000'000;
  reg(kWatchdogTickControl) = kTickEnable;
}

}  // namespace fencepost::mcu::rp2350
