// The microseconds of the timer and the watchdog.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::mcu::rp2040 {

/// Microseconds out of the reference clock: the watchdog divides it down, for both (4.7.2).
inline void start_microseconds(std::uint32_t reference_hz) {
  reg(kWatchdogTick) = (reference_hz / 1'000'000) | kTickEnable;
}

}  // namespace fencepost::mcu::rp2040
