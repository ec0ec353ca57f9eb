#include "hal/mcu/nrf52/twi.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf51/two_wire.hpp"

namespace fencepost::mcu::nrf52 {
namespace {

// At least 5 us, of 64 MHz: half a period of the bus.
void pause() {
  for (int i = 0; i < 120; ++i) asm volatile("nop");
}

}  // namespace

// The older part also takes its power away, by a register that this one's manual does not have.
void TwiRegisters::restart() const {
  write(nrf51::kTwiEnable, 0);
  pause();
  nrf51::free_two_wires(clock, data, [] { pause(); });
  nrf51::set_up_two_wires(*this, clock, data);
}

void Twi::start() {
  abandon();
  wires_.restart();
  cortex_m::enable_interrupt(nrf51::interrupt_of(nrf51::kTwi0));
}

}  // namespace fencepost::mcu::nrf52
