#include "hal/mcu/rp2/uart.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {

void Uart::start(const UartWiring& wiring, std::uint32_t clock_hz, std::uint32_t baud) {
  base_ = wiring.base;
  bring_up(wiring.reset);
  wiring.transmit.connect(kFunctionUart);
  wiring.receive.connect(kFunctionUart);
  reg(base_ + kUartControl) = 0;                                // the line may not change while it runs (4.2.7)
  const std::uint32_t divisor = (8 * clock_hz / baud + 1) / 2;  // of 16 samples a bit, in 64ths (4.2.7.1)
  reg(base_ + kUartWholeDivisor) = divisor / 64;
  reg(base_ + kUartFraction) = divisor % 64;
  reg(base_ + kUartLine) = kUartEightBits | kUartFifos;  // takes the divisor over
  reg(base_ + kUartControl) = kUartOn;
  reg(base_ + kUartInterruptEnable) = kUartReceiveInterrupts;
  cortex_m::enable_interrupt(wiring.interrupt);
}

// The send interrupt comes when the part's queue has become half empty (4.2.6.4), so somebody has to fill it first.
base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  if (base_ == 0) return out.size();
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  if (taken) send();
  return taken;
}

void Uart::on_interrupt() {
  receive();
  send();
}

void Uart::receive() {
  while ((reg(base_ + kUartFlags) & kUartNothingReceived) == 0) {
    const std::uint32_t data = reg(base_ + kUartData);
    if ((data & kUartDataFaults) != 0) rings_.lost();
    // An overrun is flagged with the byte after it, which is valid.
    if ((data & kUartDataDamaged) == 0) rings_.received(static_cast<std::uint8_t>(data & 0xFF));
  }
}

// If bytes are left in the ring the part's queue is full, so the half-empty interrupt will come.
void Uart::send() {
  std::uint8_t byte = 0;
  while ((reg(base_ + kUartFlags) & kUartSendFull) == 0) {
    if (!rings_.next(byte)) {
      reg(base_ + kUartInterruptEnable) = kUartReceiveInterrupts;
      return;
    }
    reg(base_ + kUartData) = byte;
  }
  reg(base_ + kUartInterruptEnable) = kUartReceiveInterrupts | kUartSendInterrupt;
}

}  // namespace fencepost::mcu::rp2
