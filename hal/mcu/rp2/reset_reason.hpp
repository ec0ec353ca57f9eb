// Why the part was reset.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/reset.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "hal/mcu/rp2/watchdog.hpp"

namespace fencepost::mcu::rp2 {

/// `watchdog`: WATCHDOG.REASON, zero unless the watchdog was the last. `armed`: this program had started it.
/// `chip`: CHIP_RESET, which records the last reset of another kind.
constexpr ResetReason reset_reason(std::uint32_t watchdog, bool armed, std::uint32_t chip) {
  if ((watchdog & kWatchdogByTimer) != 0 && armed) return ResetReason::kWatchdog;
  if (watchdog != 0) return ResetReason::kSoftware;
  if ((chip & kResetByPower) != 0) return ResetReason::kPowerOn;
  if ((chip & kResetByBrownOut) != 0) return ResetReason::kBrownOut;
  if ((chip & kResetByRunPin) != 0) return ResetReason::kPin;
  if ((chip & kResetByDebugger) != 0) return ResetReason::kSoftware;
  return ResetReason::kUnknown;
}

/// Before start_watchdog().
inline ResetReason read_reset_reason() {
  return reset_reason(reg(kWatchdogReason), reg(kArmedWord) == kArmed, reg(kChipReset));
}

}  // namespace fencepost::mcu::rp2
