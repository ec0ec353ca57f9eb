#include "hal/mcu/cortex_m/panic.hpp"

#include "hal/mcu/cortex_m/core.hpp"

namespace fencepost::mcu::cortex_m {
namespace {

// Memory is random after power-on: two matching words do not occur by chance.
constexpr std::uint32_t kMark = 0x50414E49;

struct Kept {
  // Nothing here has an initial value: start-up would write it.
  std::uint32_t mark;
  std::uint32_t exception;
  std::uint32_t pc;
  std::uint32_t lr;
  std::uint32_t check;  ///< ~(mark ^ exception ^ pc ^ lr)

  [[nodiscard]] std::uint32_t right_check() const { return ~(mark ^ exception ^ pc ^ lr); }
};

}  // namespace

extern "C" {
// By name, so that a test can find it in the image.
[[gnu::section(".noinit"), gnu::used]] Kept fencepost_panic;

/// Where every unhandled exception ends. `frame`: what the core has pushed (Armv7-M B1.5.6).
[[noreturn, gnu::used]] void fencepost_die(const std::uint32_t* frame) {
  fencepost_hold_motors();
  fencepost_panic.mark = kMark;
  fencepost_panic.exception = reg(kInterruptControl) & 0x1FFU;
  fencepost_panic.pc = frame[6];
  fencepost_panic.lr = frame[5];
  fencepost_panic.check = fencepost_panic.right_check();
  reset();
}

// Both stacks are one here. A trap of FENCEPOST_CHECK ends up here too: an undefined instruction.
[[gnu::naked, gnu::used]] void unexpected_exception() { asm volatile("mrs r0, msp\n\tbl fencepost_die"); }
}

std::optional<Panic> take_panic() {
  const bool there = fencepost_panic.mark == kMark && fencepost_panic.check == fencepost_panic.right_check();
  const Panic panic{fencepost_panic.exception, fencepost_panic.pc, fencepost_panic.lr};
  fencepost_panic.mark = 0;
  if (!there) return std::nullopt;
  return panic;
}

}  // namespace fencepost::mcu::cortex_m
