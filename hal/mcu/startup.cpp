#include "hal/mcu/startup.hpp"

#include <cstdint>

// The families' sections.ld have these.
extern "C" {
extern std::uint32_t image_data_source[];
extern std::uint32_t image_data_begin[];
extern std::uint32_t image_data_end[];
extern std::uint32_t image_bss_begin[];
extern std::uint32_t image_bss_end[];
extern void (*image_init_begin[])();
extern void (*image_init_end[])();
[[noreturn]] void image_main();
}

// No memcpy, no memset: they may lie in memory that is being filled.
[[gnu::optimize("no-tree-loop-distribute-patterns"), gnu::used]] void fencepost_start() {
  prepare_core();
  const std::uint32_t* source = image_data_source;
  for (std::uint32_t* word = image_data_begin; word < image_data_end; ++word) *word = *source++;
  for (std::uint32_t* word = image_bss_begin; word < image_bss_end; ++word) *word = 0;
  for (void (**init)() = image_init_begin; init < image_init_end; ++init) (*init)();
  image_main();
}
