// Copies the program from flash into RAM and starts it there. An uncached read of four bytes takes up to 2 us: a
// frame's duration would depend on the cache. And nothing can be read while flash is written.
#include "hal/mcu/cortex_m/vector_table.hpp"

extern "C" {
[[noreturn]] void load_program();
}

// The boot stage finds a stack here, and where to begin. All other vectors are of the program's table, in RAM: an
// interrupt reads it while flash is written, too.
[[gnu::section(".boot_vectors"), gnu::used]] extern constinit const std::array<fencepost::mcu::cortex_m::Handler, 2>
    boot_vectors = {image_stack_top, load_program};

// The symbols are image.ld's; fencepost_hurry is that of clocks.cpp. Runs in the flash, the rest of the code is not
// there yet.
[[gnu::naked, gnu::section(".loader"), gnu::used]] void load_program() {
  asm volatile(
      "cpsid i\n\t"
      "bl fencepost_hurry\n\t"
      "ldr r0, =image_program_source\n\t"
      "ldr r1, =image_program_begin\n\t"
      "ldr r2, =image_program_end\n\t"
      "b 2f\n"
      "1: ldm r0!, {r3}\n\t"
      "stm r1!, {r3}\n"
      "2: cmp r1, r2\n\t"
      "blo 1b\n\t"
      "ldr r0, =0xe000ed08\n\t"  // VTOR
      "ldr r1, =image_program_begin\n\t"
      "str r1, [r0]\n\t"
      "ldr r0, =reset_handler\n\t"
      "bx r0\n\t"
      ".ltorg\n\t");
}
