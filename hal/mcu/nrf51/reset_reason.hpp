// Why the part was reset, by chapter 12 (RESETREAS).
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/reset.hpp"

namespace fencepost::mcu::nrf51 {

/// Flags accumulate until they are cleared; the first known one counts. Power-on and a brown-out set none.
constexpr ResetReason reset_reason(std::uint32_t flags) {
  if ((flags & kResetByWatchdog) != 0) return ResetReason::kWatchdog;
  if ((flags & kResetByLockup) != 0) return ResetReason::kPanic;
  if ((flags & kResetBySoftware) != 0) return ResetReason::kSoftware;
  if ((flags & kResetByPin) != 0) return ResetReason::kPin;
  return flags == 0 ? ResetReason::kPowerOn : ResetReason::kUnknown;
}

/// Those of this start; clears them.
inline std::uint32_t take_reset_flags() {
  const std::uint32_t flags = reg(kResetReason);
  reg(kResetReason) = flags;
  return flags;
}
/// Of this start; clears the flags.
inline ResetReason take_reset_reason() { return reset_reason(take_reset_flags()); }

}  // namespace fencepost::mcu::nrf51
