// The micro:bit's serial line by the machine's.
#include "hal/mcu/nrf51/uart.hpp"

#include "tests/boards/mps2_an386/line.hpp"

namespace fencepost::mcu::nrf51 {

namespace machine = test::mps2;

void Uart::begin(std::uint32_t /*transmit*/, std::uint32_t /*receive*/, std::uint32_t baud) {
  machine::begin_line(machine::uart(0), machine::interrupt_of_uart(0), baud);
}

base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  go_on_sending();
  return taken;
}

void Uart::on_interrupt() { machine::serve_line(rings_, machine::uart(0)); }
void Uart::go_on_sending() { machine::send_of(rings_, machine::uart(0)); }

}  // namespace fencepost::mcu::nrf51
