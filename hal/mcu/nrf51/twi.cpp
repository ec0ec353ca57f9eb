#include "hal/mcu/nrf51/twi.hpp"

#include "hal/mcu/cortex_m/core.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

// At least 5 us, of 16 MHz: half a period of the bus.
void pause() {
  for (int i = 0; i < 30; ++i) asm volatile("nop");
}

// A device that was cut off in a byte holds the data wire until it has got its clocks: nine at most; then a stop.
void free_wires(Pin clock, Pin data) {
  clock.drive(true);
  data.drive(true);
  clock.make_two_wire_by_hand();
  data.make_two_wire();
  pause();
  for (int i = 0; i < 9 && !data.high(); ++i) {
    clock.drive(false);
    pause();
    clock.drive(true);
    pause();
  }
  data.drive(false);
  data.make_two_wire_by_hand();
  pause();
  data.drive(true);
  pause();
}

}  // namespace

void TwiRegisters::restart() const {
  write(kTwiEnable, 0);
  write(kTwiPower, 0);
  pause();
  free_wires(clock, data);
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
