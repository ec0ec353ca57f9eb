#include "hal/mcu/gba/uart.hpp"

#include "hal/mcu/gba/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::gba {
namespace {

constexpr int kHeld = 4;  // bytes each way, in the part

std::uint16_t speed(std::uint32_t baud) {
  switch (baud) {
    case 9'600: return 0;
    case 38'400: return 1;
    case 57'600: return 2;
    default: return 3;
  }
}

}  // namespace

void Uart::start(std::uint32_t baud) {
  const auto without_fifo =
      static_cast<std::uint16_t>(speed(baud) | kSerialEightBits | kSerialSend | kSerialReceive | kSerialUart);
  reg16(kLinkMode) = 0;
  reg16(kSerialControl) = without_fifo;
  reg16(kSerialControl) = without_fifo | kSerialFifo | kSerialInterrupt;
  reg16(kInterruptEnable) = static_cast<std::uint16_t>(reg16(kInterruptEnable) | kInterruptSerial);
}

void Uart::serve() {
  for (int i = 0; i < kHeld; ++i) {
    const std::uint16_t status = reg16(kSerialControl);
    if ((status & kSerialFault) != 0) rings_.lost();
    if ((status & kSerialEmpty) != 0) break;
    rings_.received(static_cast<std::uint8_t>(reg16(kSerialData) & 0xFFU));
  }
  for (int i = 0; i < kHeld; ++i) {
    std::uint8_t byte = 0;
    if ((reg16(kSerialControl) & kSerialFull) != 0 || !rings_.next(byte)) break;
    reg16(kSerialData) = byte;
  }
}

}  // namespace fencepost::mcu::gba
