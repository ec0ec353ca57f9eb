// Why the part started, and what ended the last run.
#pragma once

#include <cstdint>
#include <string_view>

namespace fencepost::mcu {

enum class ResetReason : std::uint8_t { kUnknown, kPowerOn, kBrownOut, kPin, kSoftware, kWatchdog, kPanic };

constexpr std::string_view name(ResetReason reason) {
  switch (reason) {
    case ResetReason::kUnknown: return "unknown";
    case ResetReason::kPowerOn: return "power on";
    case ResetReason::kBrownOut: return "supply too low";
    case ResetReason::kPin: return "reset pin";
    case ResetReason::kSoftware: return "software";
    case ResetReason::kWatchdog: return "watchdog";
    case ResetReason::kPanic: return "panic";
  }
  return "unknown";
}

/// A fault of the program: what, and where. Kept in memory that start-up does not touch.
struct Panic {
  std::uint32_t exception = 0;  ///< number of the exception: 3 hard fault, 16 + n interrupt n without a handler
  std::uint32_t pc = 0;         ///< address of the instruction
  std::uint32_t lr = 0;         ///< where it was called from, mostly
};

}  // namespace fencepost::mcu
