// The vector table (chapter 4.2: 32 interrupts). The board defines the handlers named here; all else ends in a panic.
#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/mcu/nrf51/registers.hpp"

extern "C" {
void image_stack_top();  // an address, of the linker's
[[noreturn]] void reset_handler();
void unexpected_exception();
void uart_interrupt();
void twi_interrupt();
void timer_interrupt();
}

namespace fencepost::mcu::nrf51 {
namespace {

using Handler = void (*)();
constexpr std::size_t kFirstInterrupt = 16;
constexpr std::size_t kInterrupts = 32;
using Table = std::array<Handler, kFirstInterrupt + kInterrupts>;

constexpr Table make_table() {
  Table table{};
  table.fill(unexpected_exception);
  table[0] = image_stack_top;
  table[1] = reset_handler;
  table[kFirstInterrupt + interrupt_of(kUart)] = uart_interrupt;
  table[kFirstInterrupt + interrupt_of(kTwi0)] = twi_interrupt;
  table[kFirstInterrupt + interrupt_of(kTimer)] = timer_interrupt;
  return table;
}

}  // namespace

[[gnu::section(".vectors"), gnu::used]] extern constinit const Table vectors = make_table();

}  // namespace fencepost::mcu::nrf51
