// The independent watchdog: it runs on a clock of its own and cannot be stopped again.
#pragma once

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// 32 kHz (17 to 47, datasheet) / 64, 200 counts: 0.4 s, 0.27 to 0.75. Shorter than a robot that hangs may drive on.
inline constexpr std::uint32_t kWatchdogCounts = 200;
/// 3 s, at least 2.0: the flash takes 0.5 s at most to erase 16 KB.
inline constexpr std::uint32_t kPatientCounts = 1500;

inline void feed_watchdog() { reg(kWatchdogKey) = kWatchdogFeed; }

/// From now on. A new count is taken over within five of its clock (RM0090 21.4.4); until then a feeding has the old
/// one.
inline void set_watchdog(std::uint32_t counts) {
  constexpr std::uint32_t kMaxPolls = 20'000;  // five of 17 kHz, and some
  reg(kWatchdogKey) = kWatchdogUnlock;
  reg(kWatchdogReload) = counts;
  static_cast<void>(await_mask(kWatchdogStatus, kWatchdogReloadBusy, 0, kMaxPolls));
  feed_watchdog();
}

inline void start_watchdog() {
  reg(kWatchdogKey) = kWatchdogUnlock;
  reg(kWatchdogPrescaler) = kWatchdogBy64;
  reg(kWatchdogReload) = kWatchdogCounts;
  reg(kWatchdogKey) = kWatchdogStart;
}

/// While the flash is erased; the motors are held then.
class PatientWatchdog {
 public:
  PatientWatchdog() { set_watchdog(kPatientCounts); }
  ~PatientWatchdog() { set_watchdog(kWatchdogCounts); }
  PatientWatchdog(const PatientWatchdog&) = delete;
  PatientWatchdog& operator=(const PatientWatchdog&) = delete;
};

}  // namespace fencepost::mcu::stm32f4
