// BBC micro:bit v2: nRF52833, 64 MHz, 128 KB of memory. What every board offers: hal/boards/README.md. Of its two
// serial lines one goes through the board's USB: the console's.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/boards/microbit_v2/pins.hpp"
#include "hal/mcu/nrf51/timer_clock.hpp"
#include "hal/mcu/nrf51/uart.hpp"
#include "hal/mcu/nrf52/flash.hpp"
#include "hal/mcu/nrf52/twi.hpp"
#include "hal/mcu/nrf52/uart.hpp"
#include "hal/mcu/reset.hpp"

namespace fencepost::board {

inline constexpr std::string_view kTarget = "microbit_v2";
inline constexpr bus::PinNames kPinNames = microbit_v2::kNames;
inline constexpr bool kOneLine = true;  ///< for a camera or a wheel base

using Clock = mcu::nrf51::TimerClock;
using Link = mcu::nrf52::Uart;
using Console = mcu::nrf51::Uart;
using I2c = mcu::nrf52::Twi;
using Flash = mcu::nrf52::Flash;

/// Before anything else here: crystal, timer, watchdog, console.
void start(std::uint32_t console_baud);
/// Before the link, the counts or the bus are used.
void start_camera(std::uint32_t baud);
void start_base(std::uint32_t baud);
void start_encoders();
void start_i2c();

Clock& clock();
Console& console();  ///< P0.06 sends, P1.08 receives: the interface chip's serial line on USB
Link& camera();      ///< P0.04 sends, ring 2; P0.02 receives, ring 0
Link& base();        ///< the same line: for a wheel base, where the camera is on the I2C bus
I2c& i2c();          ///< P0.26 is the clock, edge connector 19; P1.00 the data, 20. Nothing else is on it.
Flash& flash();
/// Modulo 2^kEncoderBits.
std::uint32_t left_count();
std::uint32_t right_count();

mcu::ResetReason take_reset_reason();
std::optional<mcu::Panic> take_panic();

/// STOP, for the enable input of a motor driver: high while the robot may drive, low from `start` on. A resistor of 10
/// k to ground holds it while the part is in reset. The lower left pixel shines while it is low.
void allow_motion(bool allowed);
/// It has been below 2.1 V since the last reset: nothing may move, and flash is not written.
bool supply_low();
/// Also drives the heartbeat: the upper left pixel blinks once a second as long as the loop runs.
void feed_watchdog();
/// Sleeps until something may have happened: a byte, or a millisecond.
void idle();

}  // namespace fencepost::board
