// The part's serial lines by the machine's.
#include "hal/mcu/rp2/uart.hpp"

#include "tests/boards/mps2_an386/line.hpp"

namespace fencepost::mcu::rp2 {

namespace machine = test::mps2;

void Uart::start(const UartWiring& wiring, std::uint32_t /*clock_hz*/, std::uint32_t baud) {
  base_ = wiring.base;
  machine::begin_line(base_, wiring.interrupt, baud);
}

base::Result<std::size_t> Uart::write(std::span<const std::uint8_t> out) {
  if (base_ == 0) return out.size();
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  machine::send_of(rings_, base_);
  return taken;
}

void Uart::on_interrupt() {
  if (base_ != 0) machine::serve_line(rings_, base_);
}

}  // namespace fencepost::mcu::rp2
