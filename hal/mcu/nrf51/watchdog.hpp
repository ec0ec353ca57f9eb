// The watchdog: it runs on the slow clock and cannot be stopped again.
#pragma once

#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {

/// 0.4 s: longer than the flash takes to erase (two times 23 ms), shorter than a robot that hangs may drive on. The
/// part keeps it running through a reset by software. It goes on while a debugger holds the core, since motors do, too.
inline void start_watchdog() {
  reg(kWatchdogConfig) = kWatchdogWhileAsleep | kWatchdogWhileHalted;
  reg(kWatchdogReload) = 4 * 32'768 / 10 - 1;
  reg(kWatchdogStart) = kTrigger;
}
inline void feed_watchdog() { reg(kWatchdogFeed) = kWatchdogFood; }

}  // namespace fencepost::mcu::nrf51
