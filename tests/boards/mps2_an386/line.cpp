// The micro:bit's second serial line by the machine's.
#include "tests/boards/mps2_an386/line.hpp"

#include "hal/mcu/nrf52/uart.hpp"

namespace fencepost::mcu::nrf52 {

namespace machine = test::mps2;

void Uart::start(Pin /*transmit*/, Pin /*receive*/, std::uint32_t baud) {
  started_ = true;
  machine::begin_line(machine::uart(1), machine::interrupt_of_uart(1), baud);
}

base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  if (started_) machine::send_of(rings_, machine::uart(1));
  return taken;
}

void Uart::on_interrupt() {
  if (started_) machine::serve_line(rings_, machine::uart(1));
}

}  // namespace fencepost::mcu::nrf52
