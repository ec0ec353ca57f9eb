// A serial line of such a machine, behind the rings of a board's.
#pragma once

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/register.hpp"
#include "tests/boards/mps2_an386/registers.hpp"

namespace fencepost::test::mps2 {

/// `n`: which of the machine's, from 0 on.
constexpr std::uint32_t uart(std::uint32_t n) { return kUart + n * kNextUart; }
constexpr std::uint32_t interrupt_of_uart(std::uint32_t n) { return kInterruptReceived + n * kNextInterrupt; }

inline void begin_line(std::uint32_t base, std::uint32_t interrupt, std::uint32_t baud) {
  mcu::reg(base + kUartDivider) = kCoreHz / baud;
  mcu::reg(base + kUartControl) = kUartOn;
  mcu::cortex_m::enable_interrupt(interrupt);
  mcu::cortex_m::enable_interrupt(interrupt + kSentAfterReceived);
}
/// Until the line is full, or nothing waits.
template <class Rings>
void send_of(Rings& rings, std::uint32_t base) {
  std::uint8_t byte = 0;
  while ((mcu::reg(base + kUartState) & kUartSendFull) == 0 && rings.next(byte)) mcu::reg(base + kUartData) = byte;
}
/// Both interrupts of the line.
template <class Rings>
void serve_line(Rings& rings, std::uint32_t base) {
  mcu::reg(base + kUartInterrupts) = kUartReceived | kUartSent;
  while ((mcu::reg(base + kUartState) & kUartReceiveFull) != 0) {
    rings.received(static_cast<std::uint8_t>(mcu::reg(base + kUartData)));
  }
  send_of(rings, base);
}

}  // namespace fencepost::test::mps2
