// How the I2C master's two wires are freed and given to it.
#pragma once

#include <cstdint>

#include "hal/mcu/free_wires.hpp"
#include "hal/mcu/nrf51/registers.hpp"

namespace fencepost::mcu::nrf51 {

/// While the master is off. `pause()`: half a period of the bus.
template <class Wire, class Pause>
void free_two_wires(Wire clock, Wire data, Pause pause) {
  for (const Wire& wire : {clock, data}) {
    wire.drive(true);
    wire.make_two_wire_by_hand();
  }
  free_wires(clock, data, pause);
}

/// The master, off until now: 100 kHz, nothing to report. `Registers`: write(offset, value).
template <class Registers, class Wire>
void set_up_two_wires(const Registers& registers, Wire clock, Wire data) {
  clock.make_two_wire();
  data.make_two_wire();
  registers.write(kTwiPinClock, clock.number);
  registers.write(kTwiPinData, data.number);
  registers.write(kTwiFrequency, kTwi100kHz);
  for (const std::uint32_t event : {kTwiStopped, kTwiReceived, kTwiSent, kTwiError}) registers.write(event, 0);
  registers.write(kTwiEnable, kTwiEnabled);
}

}  // namespace fencepost::mcu::nrf51
