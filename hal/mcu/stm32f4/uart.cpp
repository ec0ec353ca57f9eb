#include "hal/mcu/stm32f4/uart.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

void Uart::start(const UartWiring& wiring, const Clocks& clocks, std::uint32_t baud) {
  base_ = wiring.part.base;
  enable_clock(wiring.part.enable_register, wiring.part.enable_bit);
  wiring.transmit.connect(wiring.part.function);
  wiring.receive.connect(wiring.part.function);
  reg(base_ + kUsartControl) = 0;
  bytes_a_millisecond_ = (baud + 9'999) / 10'000;  // ten bits a byte
  reg(base_ + kUsartBaud) = (wiring.part.hz(clocks) + baud / 2) / baud;
  reg(base_ + kUsartControl) = kUsartEnable | kUsartReceive | kUsartSend | kUsartReceiveInterrupt;
  cortex_m::enable_interrupt(wiring.part.interrupt);
}

base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = rings_.write(out);
  // The interrupt may clear this bit in between: then it finds an empty ring once more, and clears it again.
  if (taken) set_bits(base_ + kUsartControl, kUsartSendInterrupt);
  return taken;
}

void Uart::on_interrupt() {
  const std::uint32_t status = reg(base_ + kUsartStatus);
  if ((status & (kUsartReceived | kUsartFaults)) != 0) {
    // Reading the data after the status clears both (30.6.1).
    const auto byte = static_cast<std::uint8_t>(reg(base_ + kUsartData));
    if ((status & kUsartReceived) != 0) rings_.received(byte);
    if ((status & kUsartFaults) != 0) rings_.lost();
  }
  if ((status & kUsartCanSend) != 0 && (reg(base_ + kUsartControl) & kUsartSendInterrupt) != 0 && !send_one()) {
    clear_bits(base_ + kUsartControl, kUsartSendInterrupt);
  }
}

void Uart::on_millisecond() {
  for (std::uint32_t i = 0; i < bytes_a_millisecond_; ++i) {
    if ((reg(base_ + kUsartStatus) & kUsartCanSend) == 0 || !send_one()) return;
  }
}

bool Uart::send_one() {
  std::uint8_t byte = 0;
  if (!rings_.next(byte)) return false;
  reg(base_ + kUsartData) = byte;
  return true;
}

}  // namespace fencepost::mcu::stm32f4
