#include "hal/mcu/nrf51/twi.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/free_wires.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

// At least 5 us, of 16 MHz: half a period of the bus.
void pause() {
  for (int i = 0; i < 30; ++i) asm volatile("nop");
}

void take_wire(Pin pin) {
  pin.drive(true);
  pin.make_two_wire_by_hand();
}

}  // namespace

void TwiRegisters::restart() const {
  write(kTwiEnable, 0);
  write(kTwiPower, 0);
  pause();
  take_wire(clock);
  take_wire(data);
  free_wires(clock, data, [] { pause(); });
  write(kTwiPower, 1);
  clock.make_two_wire();
  data.make_two_wire();
  write(kTwiPinClock, clock.number);
  write(kTwiPinData, data.number);
  write(kTwiFrequency, kTwi100kHz);
  for (const std::uint32_t event : {kTwiStopped, kTwiReceived, kTwiSent, kTwiError}) write(event, 0);
  write(kTwiEnable, kTwiEnabled);
}

void Twi::start() const {
  wires_.restart();
  cortex_m::enable_interrupt(interrupt_of(kTwi0));
}

}  // namespace fencepost::mcu::nrf51
