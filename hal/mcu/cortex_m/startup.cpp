#include "hal/mcu/startup.hpp"

#include <cstdint>

#include "hal/mcu/cortex_m/core.hpp"

extern "C" [[noreturn]] void reset_handler();

// The linker's.
extern "C" {
#if __ARM_ARCH >= 7
extern const std::uint32_t image_vectors[];
#endif
extern const std::uint32_t image_stack_bottom[];
}

namespace {

std::uint32_t address_of(const std::uint32_t* symbol) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(symbol));
}

#if __ARM_ARCH >= 8
// A stack that grows below its end faults, and overwrites no variable (Armv8-M B3.21).
void guard_stack() { asm volatile("msr msplim, %0" ::"r"(address_of(image_stack_bottom))); }
#else
// 32 bytes at the stack's end that nobody may use: a stack that grows into them faults, and overwrites no variable. The
// smallest region of an M0+ has 256 bytes; an eighth of it is in force.
void guard_stack() {
  namespace core = fencepost::mcu::cortex_m;
  using fencepost::mcu::reg;
  constexpr std::uint32_t kEighth = 32;
  constexpr std::uint32_t kRegion = 8 * kEighth;
  if ((reg(core::kProtectionType) & core::kProtectionRegions) == 0) return;
  const std::uint32_t guard = (address_of(image_stack_bottom) + kEighth - 1) / kEighth * kEighth;
  const std::uint32_t eighth = 1U << (guard % kRegion / kEighth);
  reg(core::kProtectionBase) = (guard - guard % kRegion) | core::kProtectionFirst;
  reg(core::kProtectionKind) = core::kProtection256 | (eighth ^ 0xFFU) << core::kProtectionEighthsOffShift;
  reg(core::kProtection) = core::kProtectionOn | core::kElseAsWithout;
  asm volatile("dsb\n\tisb" ::: "memory");
}
#endif

#if __ARM_ARCH >= 7
// A boot loader that jumps here has reset nothing: its interrupts may be on, pending, and its table in force.
void take_interrupts_over() {
  namespace core = fencepost::mcu::cortex_m;
  using fencepost::mcu::reg;
  constexpr std::uint32_t kWords = 8;  // of 32 interrupts; what the part lacks ignores it
  reg(core::kSysTickControl) = 0;
  for (std::uint32_t word = 0; word < kWords; ++word) {
    reg(core::kNvicDisable + 4 * word) = 0xFFFF'FFFF;
    reg(core::kNvicForget + 4 * word) = 0xFFFF'FFFF;
  }
  reg(core::kInterruptControl) = core::kForgetCorePending;
  reg(core::kProtection) = 0;
  reg(core::kVectorTable) = address_of(image_vectors);
  asm volatile("dsb\n\tisb" ::: "memory");
}
#endif

}  // namespace

void prepare_core() {
#if __ARM_ARCH >= 7
  take_interrupts_over();
#endif
  guard_stack();
#if defined(__ARM_FP)
  namespace core = fencepost::mcu::cortex_m;
  fencepost::mcu::set_bits(core::kCoprocessorAccess, core::kFullFloatAccess);
  asm volatile("dsb\n\tisb" ::: "memory");
#endif
  asm volatile("cpsie i" ::: "memory");
}

// The core has loaded the stack pointer from the vector table. A boot loader that jumped here may not have, and may
// have been on its other stack.
[[gnu::naked]] void reset_handler() {
  asm volatile(
      "cpsid i\n\t"
#if __ARM_ARCH >= 7
      "movs r0, #0\n\t"
      "msr control, r0\n\t"
      "isb\n\t"
      "msr basepri, r0\n\t"
      "cpsie f\n\t"
#endif
#if __ARM_ARCH >= 8
      "msr msplim, r0\n\t"
#endif
      "ldr r0, =image_stack_top\n\t"
      "mov sp, r0\n\t"
      "bl fencepost_start\n\t");
}
