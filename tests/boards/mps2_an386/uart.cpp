// The micro:bit's serial line by the machine's.
#include "hal/mcu/nrf51/uart.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/register.hpp"
#include "tests/boards/mps2_an386/registers.hpp"

namespace fencepost::mcu::nrf51 {

namespace machine = test::mps2;

void Uart::begin(std::uint32_t /*transmit*/, std::uint32_t /*receive*/, std::uint32_t baud) {
  reg(machine::kUartDivider) = machine::kCoreHz / baud;
  reg(machine::kUartControl) = machine::kUartOn;
  cortex_m::enable_interrupt(machine::kInterruptReceived);
  cortex_m::enable_interrupt(machine::kInterruptSent);
}

base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  go_on_sending();
  return taken;
}

void Uart::on_interrupt() {
  reg(machine::kUartInterrupts) = machine::kUartReceived | machine::kUartSent;
  while ((reg(machine::kUartState) & machine::kUartReceiveFull) != 0) {
    rings_.received(static_cast<std::uint8_t>(reg(machine::kUartData)));
  }
  go_on_sending();
}

void Uart::go_on_sending() {
  sending_ = true;
  while (sending_ && (reg(machine::kUartState) & machine::kUartSendFull) == 0) sending_ = send_one();
}

bool Uart::send_one() {
  std::uint8_t byte = 0;
  if (!rings_.next(byte)) return false;
  reg(machine::kUartData) = byte;
  return true;
}

}  // namespace fencepost::mcu::nrf51
