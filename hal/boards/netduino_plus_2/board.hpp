// Boards with an STM32F405: Netduino Plus 2, pyboard, Feather F405. They differ in their pins.hpp alone; a program that
// includes this is compiled once for all of them. What every board offers: hal/boards/README.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/bus/pin_names.hpp"
#include "hal/mcu/reset.hpp"
#include "hal/mcu/stm32f4/encoder.hpp"
#include "hal/mcu/stm32f4/flash.hpp"
#include "hal/mcu/stm32f4/i2c.hpp"
#include "hal/mcu/stm32f4/timer_clock.hpp"
#include "hal/mcu/stm32f4/uart.hpp"

namespace fencepost::board {

extern const std::string_view kTarget;
extern const bus::PinNames kPinNames;
inline constexpr int kEncoderBits = 16;

using Clock = mcu::stm32f4::TimerClock;
using Link = mcu::stm32f4::Uart;
using I2c = mcu::stm32f4::I2c;
using Flash = mcu::stm32f4::Flash;

/// Before anything else here: clocks, timer, watchdog, console.
void start(std::uint32_t console_baud);
/// Before the link is used.
void start_camera(std::uint32_t baud);
void start_base(std::uint32_t baud);
void start_encoders();
void start_i2c();

Clock& clock();
Link& console();
Link& camera();
Link& base();  ///< a wheel base such as a Create
I2c& i2c();    ///< a Pixy2 or NXTCam
Flash& flash();
/// Modulo 2^kEncoderBits.
std::uint32_t left_count();
std::uint32_t right_count();

mcu::ResetReason take_reset_reason();
std::optional<mcu::Panic> take_panic();

/// STOP, for the enable input of a motor driver: high while the robot may drive, low from `start` on. A resistor of 10
/// k to ground holds it while the part is in reset.
void allow_motion(bool allowed);
/// Below 2.7 V: nothing may move, and flash is not written.
bool supply_low();
/// The light flashes once a second while the loop runs.
void feed_watchdog();
/// Sleeps until something may have happened: a byte, or a millisecond.
void idle();

}  // namespace fencepost::board
