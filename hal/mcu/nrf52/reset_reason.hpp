// Why the part was reset, by its register RESETREAS (POWER).
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/reset_reason.hpp"

namespace fencepost::mcu::nrf52 {

/// As on the older part; but behind a reset by the pin other flags are set, too, which mean nothing (anomaly 136 of the
/// nRF52833).
constexpr ResetReason reset_reason(std::uint32_t flags) {
  return (flags & nrf51::kResetByPin) != 0 ? ResetReason::kPin : nrf51::reset_reason(flags);
}

/// Of this start; clears the flags.
inline ResetReason take_reset_reason() { return reset_reason(nrf51::take_reset_flags()); }

}  // namespace fencepost::mcu::nrf52
