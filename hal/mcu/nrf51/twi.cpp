#include "hal/mcu/nrf51/twi.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf51/two_wire.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

// At least 5 us, of 16 MHz: half a period of the bus.
void pause() {
  for (int i = 0; i < 30; ++i) asm volatile("nop");
}

}  // namespace

void TwiRegisters::restart() const {
  write(kTwiEnable, 0);
  write(kTwiPower, 0);
  pause();
  free_two_wires(clock, data, [] { pause(); });
  write(kTwiPower, 1);
  set_up_two_wires(*this, clock, data);
}

void Twi::start() {
  abandon();
  wires_.restart();
  cortex_m::enable_interrupt(interrupt_of(kTwi0));
}

}  // namespace fencepost::mcu::nrf51
