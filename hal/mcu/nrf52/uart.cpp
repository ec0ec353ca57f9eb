#include "hal/mcu/nrf52/uart.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf52/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf52 {
namespace {

using nrf51::kTrigger;

constexpr int kFifo = 6;  // bytes that the part holds while it may not write to memory

constexpr std::uint32_t kMaxPolls = 200'000;  // at least 15 ms: four bytes of 9600 baud take 4

std::uint32_t address_of(const volatile std::uint8_t& byte) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&byte));
}

}  // namespace

// Switched off only once both ways have come to an end (UARTE, low power).
void stop_line() {
  reg(kLineInterruptsOff) = ~0U;
  if (reg(kLineEnable) == kLineEnabled) {
    reg(kLineShorts) = 0;
    reg(kLineReceivingStopped) = 0;
    reg(kLineSendingStopped) = 0;
    reg(kLineStopReceiving) = kTrigger;
    reg(kLineStopSending) = kTrigger;
    static_cast<void>(await_bits(kLineReceivingStopped, 1, kMaxPolls));
    static_cast<void>(await_bits(kLineSendingStopped, 1, kMaxPolls));
  }
  reg(kLineEnable) = 0;
}

void Uart::start(Pin transmit, Pin receive, std::uint32_t baud) {
  stop_line();
  transmit.drive(true);
  transmit.make_output();
  receive.make_input();
  reg(kLinePinSend) = transmit.number;
  reg(kLinePinReceive) = receive.number;
  reg(kLineBaud) = line_setting(baud);
  reg(kLineFormat) = 0;
  reg(kLineReceivesTo) = address_of(arrived_);
  reg(kLineReceivesBytes) = 1;
  reg(kLineSendsFrom) = address_of(leaving_);
  reg(kLineSendsBytes) = 1;
  for (const std::uint32_t event : {kLineReceived, kLineSent, kLineError}) reg(event) = 0;
  reg(kLineEnable) = kLineEnabled;
  reg(kLineInterrupts) = kLineReceivedInterrupt | kLineSentInterrupt | kLineErrorInterrupt;
  cortex_m::enable_interrupt(nrf51::interrupt_of(kLine));
  reg(kLineStartReceiving) = kTrigger;
  started_ = true;
  sending_ = send_one();
}

// Nothing is sent before the line is set up.
base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  if (taken && started_ && !sending_) sending_ = send_one();
  return taken;
}

// A byte that is damaged is not written to memory, and the line goes on waiting for one.
void Uart::on_interrupt() {
  if (reg(kLineError) != 0) {
    reg(kLineError) = 0;
    reg(kLineErrorSource) = kLineErrors;
    rings_.lost();
  }
  // Those that the part holds follow at once.
  for (int i = 0; i < kFifo && reg(kLineReceived) != 0; ++i) {
    reg(kLineReceived) = 0;
    rings_.received(arrived_);
    reg(kLineStartReceiving) = kTrigger;
  }
  if (reg(kLineSent) != 0) {
    reg(kLineSent) = 0;
    sending_ = send_one();
  }
}

bool Uart::send_one() {
  std::uint8_t byte = 0;
  if (!rings_.next(byte)) return false;
  leaving_ = byte;
  reg(kLineStartSending) = kTrigger;
  return true;
}

}  // namespace fencepost::mcu::nrf52
