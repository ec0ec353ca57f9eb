// The watchdog, and its eight words that a reset leaves alone.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {

// The boot loader on the USB disk starts a new program by the watchdog's timer, too: this word says that it was ours.
// The ROM clears it then, and leaves it alone otherwise (RP2040 2.8.1.1, RP2350 5.2.4).
inline constexpr std::uint32_t kArmedWord = kWatchdogScratch + 4 * 4;  // its address
inline constexpr std::uint32_t kArmed = 0x66E6'CE05;                   // its value

/// 0.4 s: shorter than a robot that hangs may drive on.
inline constexpr std::uint32_t kWatchdogCount = 400'000 * kCountsPerMicrosecond;
/// 3 s: the flash takes 0.4 s at most to erase a sector.
inline constexpr std::uint32_t kPatientCount = 3'000'000 * kCountsPerMicrosecond;

/// After the clock: it counts the same microseconds. It goes on while a debugger holds the core, since motors do, too.
inline void start_watchdog() {
  reg(kPowerWatchdogSelect) = kAllButOscillators;
  reg(kArmedWord) = kArmed;
  reg(kWatchdogLoad) = kWatchdogCount;
  reg(kWatchdogControl) = kWatchdogEnable;
}
inline void feed_watchdog() { reg(kWatchdogLoad) = kWatchdogCount; }

/// While the flash is erased; the motors are held then.
class PatientWatchdog {
 public:
  PatientWatchdog() { reg(kWatchdogLoad) = kPatientCount; }
  ~PatientWatchdog() { feed_watchdog(); }
  PatientWatchdog(const PatientWatchdog&) = delete;
  PatientWatchdog& operator=(const PatientWatchdog&) = delete;
};

}  // namespace fencepost::mcu::rp2
