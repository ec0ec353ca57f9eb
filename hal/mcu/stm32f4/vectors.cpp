// The vector table (RM0090 table 61). The board defines the handlers named here; all else ends in a panic.
#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/mcu/stm32f4/registers.hpp"

extern "C" {
void image_stack_top();  // an address, of the linker's
[[noreturn]] void reset_handler();
void unexpected_exception();
void systick_interrupt();
void i2c1_event_interrupt();
void i2c1_error_interrupt();
void usart1_interrupt();
void usart2_interrupt();
void usart3_interrupt();
}

namespace fencepost::mcu::stm32f4 {
namespace {

using Handler = void (*)();
constexpr std::size_t kFirstInterrupt = 16;
constexpr std::size_t kSysTick = 15;
constexpr std::size_t kInterrupts = 82;
using Table = std::array<Handler, kFirstInterrupt + kInterrupts>;

constexpr Table make_table() {
  Table table{};
  table.fill(unexpected_exception);
  table[0] = image_stack_top;
  table[1] = reset_handler;
  table[kSysTick] = systick_interrupt;
  table[kFirstInterrupt + kInterruptI2c1Event] = i2c1_event_interrupt;
  table[kFirstInterrupt + kInterruptI2c1Error] = i2c1_error_interrupt;
  table[kFirstInterrupt + kInterruptUsart1] = usart1_interrupt;
  table[kFirstInterrupt + kInterruptUsart2] = usart2_interrupt;
  table[kFirstInterrupt + kInterruptUsart3] = usart3_interrupt;
  return table;
}

}  // namespace

[[gnu::section(".vectors"), gnu::used]] extern constinit const Table vectors = make_table();

}  // namespace fencepost::mcu::stm32f4
