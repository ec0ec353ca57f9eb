// What this part needs that the nRF51822 does not, before its peripherals are set up.
#pragma once

#include <cstdint>

namespace fencepost::mcu::nrf52 {

/// Timer, serial lines, I2C master and watched edges stopped; the cache of instructions on. A program that a debugger
/// ended without a reset left them running.
void start_part();

/// The pin with this number resets the part: written to its configuration where nothing is there, which a mass erasure
/// leaves behind, and then the part is reset. What somebody else has written stays.
void connect_reset_pin(std::uint32_t number);

}  // namespace fencepost::mcu::nrf52
