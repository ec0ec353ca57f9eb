// The clock tree: kCoreHz for the core, 48 MHz for USB, out of the board's crystal of 12 MHz.
#pragma once

#include <cstdint>

namespace fencepost::mcu::rp2 {

/// Hz, as they came to be.
struct Clocks {
  std::uint32_t reference = 0;  ///< of timer and watchdog
  std::uint32_t core = 0;       ///< and of the peripherals
  bool usb = false;             ///< the 48 MHz are there
};

/// From whatever state a debugger or a loader has left. Where the crystal does not start, the part continues with its
/// ring oscillator at some kRingHz. The loop runs then, and baud rates may be wrong by a third. Where a PLL does not
/// lock it runs at the crystal's 12 MHz, with correct baud rates.
Clocks start_clocks();

extern "C" {
/// The core's clock alone, by code in the flash: what copies the program takes 0.1 s then, and 1.5 s from the ring
/// oscillator.
void fencepost_hurry();
}

}  // namespace fencepost::mcu::rp2
