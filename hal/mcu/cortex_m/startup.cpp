#include "hal/mcu/startup.hpp"

#include "hal/mcu/cortex_m/core.hpp"

extern "C" [[noreturn]] void reset_handler();

void prepare_core() {
#if defined(__ARM_FP)
  namespace core = fencepost::mcu::cortex_m;
  fencepost::mcu::set_bits(core::kCoprocessorAccess, core::kFullFloatAccess);
  asm volatile("dsb\n\tisb" ::: "memory");
#endif
}

// The core has loaded the stack pointer from the vector table; a boot loader that jumped here may not have.
[[gnu::naked]] void reset_handler() {
  asm volatile(
      "ldr r0, =image_stack_top\n\t"
      "mov sp, r0\n\t"
      "bl fencepost_start\n\t");
}
