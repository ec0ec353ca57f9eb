// Start-up of this part that the nRF51822 does not need, before its peripherals are set up.
#pragma once

#include <cstdint>

namespace fencepost::mcu::nrf52 {

/// Timer, serial lines, I2C master and watched edges stopped; the cache of instructions on. A program that a debugger
/// ended without a reset left them running.
void start_part();

/// The pin with this number resets the part. It is written to the part's configuration where that is empty, as a mass
/// erasure leaves it; then the part is reset. A value that somebody else has written stays.
void connect_reset_pin(std::uint32_t number);

}  // namespace fencepost::mcu::nrf52
