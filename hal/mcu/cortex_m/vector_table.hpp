// The table by which the core starts and takes its exceptions (Armv6-M B1.5.3, Armv7-M B1.5.3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

extern "C" {
void image_stack_top();  // an address, of the linker's
void unexpected_exception();
}

namespace fencepost::mcu::cortex_m {

using Handler = void (*)();

inline constexpr std::uint32_t kFirstInterrupt = 16;  ///< exceptions 1 to 15 are the core's own
inline constexpr std::uint32_t kSysTick = 15;

template <std::size_t kInterrupts>
using VectorTable = std::array<Handler, kFirstInterrupt + kInterrupts>;

struct Vector {
  std::uint32_t exception;
  Handler handler;
};
/// `number`: as the part's manual counts its interrupts.
constexpr Vector of_interrupt(std::uint32_t number, Handler handler) { return {kFirstInterrupt + number, handler}; }

/// `reset`: where the part starts. Of all that `vectors` does not name the handler is a panic.
template <std::size_t kInterrupts, std::size_t kVectors>
consteval VectorTable<kInterrupts> make_vector_table(Handler reset, const Vector (&vectors)[kVectors]) {
  VectorTable<kInterrupts> table{};
  table.fill(unexpected_exception);
#if __ARM_ARCH < 7
  // Reserved there. A micro:bit v2 takes an image for that of a v1, and refuses it, if words 4 to 6 are zero (DAPLink).
  for (const std::size_t reserved : {4U, 5U, 6U, 7U, 8U, 9U, 10U, 12U, 13U}) table[reserved] = nullptr;
#endif
  table[0] = image_stack_top;
  table[1] = reset;
  for (const Vector& vector : vectors) table[vector.exception] = vector.handler;
  return table;
}

}  // namespace fencepost::mcu::cortex_m
