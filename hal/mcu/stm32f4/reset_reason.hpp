// Why the part was reset, by RM0090 7.3.21.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/reset.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// Several flags are set at a time: every reset pulls the pin, power-on also looks like a brown-out. The first known
/// one counts.
constexpr ResetReason reset_reason(std::uint32_t status) {
  if ((status & (kResetByWatchdog | kResetByWindowWatchdog)) != 0) return ResetReason::kWatchdog;
  if ((status & kResetBySoftware) != 0) return ResetReason::kSoftware;
  if ((status & kResetByPower) != 0) return ResetReason::kPowerOn;
  if ((status & kResetByBrownOut) != 0) return ResetReason::kBrownOut;
  if ((status & kResetByPin) != 0) return ResetReason::kPin;
  return ResetReason::kUnknown;
}

/// Of this start; clears the flags.
inline ResetReason take_reset_reason() {
  const std::uint32_t status = reg(kRccStatus);
  set_bits(kRccStatus, kForgetResets);
  return reset_reason(status);
}

}  // namespace fencepost::mcu::stm32f4
