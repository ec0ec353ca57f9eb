// A two-wire bus of which nothing is heard: where the micro:bit has its master this machine has nothing, and no pins.
#include "hal/mcu/nrf52/twi.hpp"

namespace fencepost::mcu::nrf52 {

void TwiRegisters::restart() const {}
void Twi::start() { abandon(); }

}  // namespace fencepost::mcu::nrf52
