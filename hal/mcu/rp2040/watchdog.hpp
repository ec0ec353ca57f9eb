// The watchdog, and its eight words that a reset leaves alone.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::mcu::rp2040 {

// The boot loader on the USB disk starts a new program by the watchdog's timer, too: this word says that it was ours.
// The ROM clears it then, and leaves it alone otherwise (2.8.1.1).
inline constexpr std::uint32_t kArmedWord = kWatchdogScratch + 4 * 4;
inline constexpr std::uint32_t kArmed = 0x66E6'CE05;

/// 3 s: the timer counts two a microsecond (erratum RP2040-E1). Longer than the flash takes to erase a sector (0.4 s at
/// most), shorter than a person would wait.
inline constexpr std::uint32_t kWatchdogCount = 6'000'000;

/// After the clock: it counts the same microseconds.
inline void start_watchdog() {
  reg(kPowerWatchdogSelect) = kAllButOscillators;
  reg(kArmedWord) = kArmed;
  reg(kWatchdogLoad) = kWatchdogCount;
  reg(kWatchdogControl) = kWatchdogEnable | kWatchdogPauses;
}
inline void feed_watchdog() { reg(kWatchdogLoad) = kWatchdogCount; }

}  // namespace fencepost::mcu::rp2040
