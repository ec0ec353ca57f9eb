#include "hal/mcu/startup.hpp"

#include <cstdint>

extern "C" {
extern std::uint32_t image_fast_source[];
extern std::uint32_t image_fast_begin[];
extern std::uint32_t image_fast_code_end[];
[[noreturn]] void reset_handler();
}

// No memcpy: it may lie in the memory that is being filled.
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void prepare_core() {
  const std::uint32_t* source = image_fast_source;
  for (std::uint32_t* word = image_fast_begin; word < image_fast_code_end; ++word) *word = *source++;
}

// The core starts in ARM state. Interrupt mode (0x12) and system mode (0x1F) have a stack pointer each; the
// supervisor's is the BIOS's own (ARM7TDMI manual, DDI 0029, 2.6 and 2.8).
[[gnu::naked, gnu::target("arm"), gnu::section(".text.reset")]] void reset_handler() {
  asm volatile(
      "mov r0, #0x92\n\t"
      "msr cpsr_c, r0\n\t"
      "ldr sp, =image_interrupt_stack_top\n\t"
      "mov r0, #0x1F\n\t"
      "msr cpsr_c, r0\n\t"
      "ldr sp, =image_stack_top\n\t"
      "ldr r0, =fencepost_start\n\t"
      "bx r0\n\t"
      ".ltorg");
}
