// The vector table (RP2040 datasheet 2.3.2). The board defines the handlers named here; all else ends in a panic.
#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/mcu/rp2040/registers.hpp"

extern "C" {
void image_stack_top();  // an address, of the linker's
[[noreturn]] void load_program();
void unexpected_exception();
void timer_interrupt();
void usb_interrupt();
void pins_interrupt();
void uart0_interrupt();
void uart1_interrupt();
void i2c_interrupt();
}

namespace fencepost::mcu::rp2040 {
namespace {

using Handler = void (*)();
constexpr std::size_t kFirstInterrupt = 16;
constexpr std::size_t kInterrupts = 26;
using Table = std::array<Handler, kFirstInterrupt + kInterrupts>;

constexpr Table make_table() {
  Table table{};
  table.fill(unexpected_exception);
  table[0] = image_stack_top;
  table[1] = load_program;
  table[kFirstInterrupt + kInterruptTimer0] = timer_interrupt;
  table[kFirstInterrupt + kInterruptUsb] = usb_interrupt;
  table[kFirstInterrupt + kInterruptPins] = pins_interrupt;
  table[kFirstInterrupt + kInterruptUart0] = uart0_interrupt;
  table[kFirstInterrupt + kInterruptUart1] = uart1_interrupt;
  table[kFirstInterrupt + kInterruptI2c0] = i2c_interrupt;
  return table;
}

}  // namespace

[[gnu::section(".vectors"), gnu::used]] extern constinit const Table vectors = make_table();

}  // namespace fencepost::mcu::rp2040
