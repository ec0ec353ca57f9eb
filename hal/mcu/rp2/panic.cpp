#include "hal/mcu/rp2/panic.hpp"

#include <cstdint>

#include "hal/mcu/cortex_m/registers.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {
namespace {

// Words 0 to 3: exception, pc, lr, check. The core's own reset request would leave USB and clocks as they are
// (2.4.2.9), so it is the watchdog that resets.
constexpr std::uint32_t word(std::uint32_t n) { return kWatchdogScratch + 4 * n; }
constexpr std::uint32_t check(const Panic& panic) { return ~(0x50414E49U ^ panic.exception ^ panic.pc ^ panic.lr); }

}  // namespace

extern "C" {
/// Where every unhandled exception ends. `frame`: what the core has pushed (Armv6-M B1.5.6).
[[noreturn, gnu::used]] void fencepost_die(const std::uint32_t* frame) {
  fencepost_hold_motors();
  const Panic panic = {reg(cortex_m::kInterruptControl) & 0x1FFU, frame[6], frame[5]};
  reg(word(0)) = panic.exception;
  reg(word(1)) = panic.pc;
  reg(word(2)) = panic.lr;
  reg(word(3)) = check(panic);
  reg(kPowerWatchdogSelect) = kAllButOscillators;
  for (;;) raise_bits(kWatchdogControl, kWatchdogTrigger);
}

// Both stacks are one here. A trap of FENCEPOST_CHECK ends up here too: an undefined instruction.
[[gnu::naked, gnu::used]] void unexpected_exception() {
  asm volatile(
      "mrs r0, msp\n\t"
      "ldr r1, =fencepost_die\n\t"
      "bx r1\n\t"
      ".ltorg\n\t");
}
}

std::optional<Panic> take_panic() {
  const Panic panic = {reg(word(0)), reg(word(1)), reg(word(2))};
  const bool there = reg(word(3)) == check(panic);
  reg(word(3)) = 0;
  if (!there || panic.exception == 0) return std::nullopt;
  return panic;
}

}  // namespace fencepost::mcu::rp2
