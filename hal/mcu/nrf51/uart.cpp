#include "hal/mcu/nrf51/uart.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

constexpr int kFifo = 6;  // bytes that the part holds

}  // namespace

void Uart::begin(std::uint32_t transmit, std::uint32_t receive, std::uint32_t baud) {
  reg(kUartPinSend) = transmit;
  reg(kUartPinReceive) = receive;
  reg(kUartBaud) = baud_setting(baud);
  reg(kUartEnable) = kUartEnabled;
  reg(kUartInterrupts) = kUartReceivedInterrupt | kUartSentInterrupt | kUartErrorInterrupt;
  reg(kUartReceived) = 0;
  reg(kUartSent) = 0;
  cortex_m::enable_interrupt(interrupt_of(kUart));
  reg(kUartStartReceiving) = kTrigger;
  reg(kUartStartSending) = kTrigger;
}

base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = rings_.write(out);
  if (taken && !sending_) {
    const cortex_m::InterruptsHeld held;
    if (!sending_) sending_ = send_one();
  }
  return taken;
}

void Uart::on_interrupt() {
  if (reg(kUartError) != 0) {
    reg(kUartError) = 0;
    reg(kUartErrorSource) = kUartErrors;
    rings_.lost();
  }
  // The event is cleared before the byte is read: reading moves the next one up, which is an event of its own (29.5).
  for (int i = 0; i < kFifo && reg(kUartReceived) != 0; ++i) {
    reg(kUartReceived) = 0;
    rings_.received(static_cast<std::uint8_t>(reg(kUartRxd)));
  }
  go_on_sending();
}

void Uart::go_on_sending() {
  if (reg(kUartSent) == 0) return;
  reg(kUartSent) = 0;
  sending_ = send_one();
}

bool Uart::send_one() {
  std::uint8_t byte = 0;
  if (!rings_.next(byte)) return false;
  reg(kUartTxd) = byte;
  return true;
}

}  // namespace fencepost::mcu::nrf51
