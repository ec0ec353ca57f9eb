// The core itself: interrupts, sleep, reset.
#pragma once

#include <cstdint>

#include "hal/mcu/cortex_m/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::cortex_m {

inline void enable_interrupt(std::uint32_t number) { reg(kNvicEnable + 4 * (number / 32)) = 1U << (number % 32); }

/// The core's own timer: an interrupt a millisecond, which wakes the loop. `core_hz`: what the core runs at, in fact.
inline void start_ticks(std::uint32_t core_hz) {
  reg(kSysTickReload) = core_hz / 1000 - 1;
  reg(kSysTickCurrent) = 0;
  reg(kSysTickControl) = kSysTickEnable | kSysTickInterrupt | kSysTickCoreClock;
}

/// Interrupts are held off during its lifetime. Keep it short: bytes are lost meanwhile.
class InterruptsHeld {
 public:
  InterruptsHeld() { asm volatile("cpsid i" ::: "memory"); }
  InterruptsHeld(const InterruptsHeld&) = delete;
  InterruptsHeld& operator=(const InterruptsHeld&) = delete;
  ~InterruptsHeld() { asm volatile("cpsie i" ::: "memory"); }
};

/// Sleeps until an interrupt, unless there is `work()` already. A pending interrupt wakes the core even while held off,
/// so none is missed between the check and the sleep.
template <class Work>
void sleep_unless(Work&& work) {
  const InterruptsHeld held;
  if (!work()) asm volatile("dsb\n\twfi" ::: "memory");
}

[[noreturn]] inline void reset() {
  asm volatile("dsb" ::: "memory");
  reg(kResetControl) = kResetRequest;
  for (;;) {
  }
}

}  // namespace fencepost::mcu::cortex_m
