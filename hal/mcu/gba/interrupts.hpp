// Interrupts of the Game Boy Advance, and sleep.
#pragma once

#include <cstdint>

#include "hal/mcu/gba/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::gba {

/// The BIOS answers interrupts: it saves r0-r3, r12 and lr on the interrupts' stack and calls `handler`. That clears
/// the flags (take_interrupts). Source: GBATEK, BIOS interrupt handling.
inline void start_interrupts(void (*handler)()) {
  reg16(kInterruptEnable) = 0;
  reg(kInterruptHandler) = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(handler));
  reg16(kInterruptMaster) = 1;
}

/// In the handler: the pending interrupts, which this acknowledges.
inline std::uint16_t take_interrupts() {
  const auto which = static_cast<std::uint16_t>(reg16(kInterruptEnable) & reg16(kInterruptFlags));
  reg16(kInterruptFlags) = which;
  reg16(kBiosInterruptFlags) = static_cast<std::uint16_t>(reg16(kBiosInterruptFlags) | which);
  return which;
}

/// Sleeps until an interrupt, unless there is `work()` already. A pending interrupt wakes the core even while held off,
/// so none is missed between the check and the sleep.
template <class Work>
void sleep_unless(Work&& work) {
  reg16(kInterruptMaster) = 0;
  // Halt through the BIOS, which owns the register. It may overwrite r0-r3.
  if (!work() && (reg16(kInterruptEnable) & reg16(kInterruptFlags)) == 0) {
    asm volatile("swi 0x02" ::: "r0", "r1", "r2", "r3", "memory");
  }
  reg16(kInterruptMaster) = 1;
}

}  // namespace fencepost::mcu::gba
