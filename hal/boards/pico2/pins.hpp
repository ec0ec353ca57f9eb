// Raspberry Pi Pico 2: the pins of a Pico. Sources: its datasheet, chapter 2.1 (pinout); functions by the RP2350
// datasheet, 9.4.
#pragma once

#include "hal/boards/pico/pins.hpp"

namespace fencepost::board::pico2 {

inline constexpr Wiring kWiring = [] {
  Wiring wiring = pico::kWiring;
  wiring.target = "pico2";
  return wiring;
}();

}  // namespace fencepost::board::pico2
