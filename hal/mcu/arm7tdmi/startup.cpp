// From reset to image_main: stacks and memory as C++ expects them. Symbols come from sections.ld.
#include <cstdint>

extern "C" {
extern std::uint32_t image_fast_source[];
extern std::uint32_t image_fast_begin[];
extern std::uint32_t image_fast_code_end[];
extern std::uint32_t image_data_source[];
extern std::uint32_t image_data_begin[];
extern std::uint32_t image_data_end[];
extern std::uint32_t image_bss_begin[];
extern std::uint32_t image_bss_end[];
extern void (*image_init_begin[])();
extern void (*image_init_end[])();
[[noreturn]] void image_main();

[[noreturn, gnu::used]] void fencepost_start();
[[noreturn]] void reset_handler();
}

namespace {

// No memcpy: it may lie in the memory that is being filled.
[[gnu::optimize("no-tree-loop-distribute-patterns"), gnu::noinline]] void copy(const std::uint32_t* source,
                                                                               std::uint32_t* begin,
                                                                               const std::uint32_t* end) {
  while (begin < end) *begin++ = *source++;
}

}  // namespace

[[gnu::optimize("no-tree-loop-distribute-patterns")]] void fencepost_start() {
  copy(image_fast_source, image_fast_begin, image_fast_code_end);
  copy(image_data_source, image_data_begin, image_data_end);
  for (std::uint32_t* word = image_bss_begin; word < image_bss_end; ++word) *word = 0;
  for (void (**init)() = image_init_begin; init < image_init_end; ++init) (*init)();
  image_main();
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
