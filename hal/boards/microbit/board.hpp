// BBC micro:bit v1: nRF51822, 16 MHz, 16 KB of memory. What every board offers: hal/boards/README.md. It has one serial
// line, through the board's USB; a camera is on the I2C bus of the edge connector.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/bus/pin_names.hpp"
#include "hal/mcu/nrf51/flash.hpp"
#include "hal/mcu/nrf51/timer_clock.hpp"
#include "hal/mcu/nrf51/twi.hpp"
#include "hal/mcu/nrf51/uart.hpp"
#include "hal/mcu/reset.hpp"

namespace fencepost::board {

inline constexpr std::string_view kTarget = "microbit";
/// Of the edge connector.
inline constexpr bus::PinNames kPinNames = {{}, {}, "20 data, 19 clock", {}};

using Clock = mcu::nrf51::TimerClock;
using Link = mcu::nrf51::Uart;
using I2c = mcu::nrf51::Twi;
using Flash = mcu::nrf51::Flash;

/// Before anything else here: crystal, timer, watchdog, console.
void start(std::uint32_t console_baud);
/// Before the bus is used.
void start_i2c();

Clock& clock();
Link& console();  ///< P0.24 sends, P0.25 receives: the interface chip's serial line on USB
I2c& i2c();       ///< P0.00 is the clock, edge connector 19; P0.30 the data, 20. The board's own sensors share it.
Flash& flash();

mcu::ResetReason take_reset_reason();
std::optional<mcu::Panic> take_panic();

/// STOP, for the enable input of a motor driver: high while the robot may drive, low from `start` on. A resistor of 10
/// k to ground holds it while the part is in reset.
void allow_motion(bool allowed);
/// Also drives the heartbeat: the upper left pixel blinks once a second as long as the loop runs.
void feed_watchdog();
/// Sleeps until something may have happened: a byte, or a millisecond.
void idle();

}  // namespace fencepost::board
