// The independent watchdog: it runs on a clock of its own and cannot be stopped again.
#pragma once

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// 32 kHz (17 to 47, datasheet) / 64, 1500 counts: 3 s, at least 2.0 s. Longer than the flash takes to erase 16 KB
/// (0.5 s at most), shorter than a person would wait.
inline void start_watchdog() {
  reg(kWatchdogKey) = kWatchdogUnlock;
  reg(kWatchdogPrescaler) = kWatchdogBy64;
  reg(kWatchdogReload) = 1500;
  reg(kWatchdogKey) = kWatchdogStart;
}
inline void feed_watchdog() { reg(kWatchdogKey) = kWatchdogFeed; }

}  // namespace fencepost::mcu::stm32f4
