// From reset to image_main: memory as C++ expects it. Symbols come from sections.ld.
#include <cstdint>

#include "hal/mcu/cortex_m/core.hpp"

extern "C" {
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

void prepare_float_unit() {
#if defined(__ARM_FP)
  namespace core = fencepost::mcu::cortex_m;
  fencepost::mcu::set_bits(core::kCoprocessorAccess, core::kFullFloatAccess);
  asm volatile("dsb\n\tisb" ::: "memory");
#endif
}

}  // namespace

// No memcpy, no memset: the compiler must not make calls of these loops before the float unit is on.
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void fencepost_start() {
  prepare_float_unit();
  const std::uint32_t* source = image_data_source;
  for (std::uint32_t* word = image_data_begin; word < image_data_end; ++word) *word = *source++;
  for (std::uint32_t* word = image_bss_begin; word < image_bss_end; ++word) *word = 0;
  for (void (**init)() = image_init_begin; init < image_init_end; ++init) (*init)();
  image_main();
}

// The core has loaded the stack pointer from the vector table; a boot loader that jumped here may not have.
[[gnu::naked]] void reset_handler() {
  asm volatile(
      "ldr r0, =image_stack_top\n\t"
      "mov sp, r0\n\t"
      "bl fencepost_start\n\t");
}
