// Boards with an RP2040, 125 MHz, 264 KB of memory, of whose two cores one is used: Raspberry Pi Pico, XRP. They differ
// in their pins.hpp alone. What every board offers: hal/boards/README.md. The console is on USB, on a Pico on a serial
// line at the same time.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/bus/pin_names.hpp"
#include "hal/mcu/mirrored_link.hpp"
#include "hal/mcu/reset.hpp"
#include "hal/mcu/rp2/encoder.hpp"
#include "hal/mcu/rp2/flash.hpp"
#include "hal/mcu/rp2/i2c.hpp"
#include "hal/mcu/rp2/timer_clock.hpp"
#include "hal/mcu/rp2/uart.hpp"
#include "hal/mcu/rp2/usb_serial.hpp"

namespace fencepost::board {

extern const std::string_view kTarget;
extern const bus::PinNames kPinNames;
inline constexpr int kEncoderBits = 16;
inline constexpr bool kOneLine = true;  ///< for a camera or a wheel base
/// The controller keeps 0 to 7 for itself (RP2040 datasheet, IC_TAR).
inline constexpr std::uint8_t kLowestAddress = 8;
inline constexpr bool kMotors = true;  ///< it drives two

using Clock = mcu::rp2::TimerClock;
using Link = mcu::rp2::Uart;
using Console = mcu::MirroredLink<mcu::rp2::Uart, mcu::rp2::UsbSerial>;
using I2c = mcu::rp2::I2c;
using Flash = mcu::rp2::Flash;

/// Before anything else here: clocks, timer, watchdog, console.
void start(std::uint32_t console_baud);
/// Before the link is used.
void start_camera(std::uint32_t baud);
void start_base(std::uint32_t baud);
void start_encoders();
void start_i2c();

Clock& clock();
// Their pins: pins.hpp.
Console& console();  ///< USB, and a serial line where there is one
Link& camera();
Link& base();  ///< the same line: for a wheel base, where the camera is on the I2C bus
I2c& i2c();
Flash& flash();
/// Modulo 2^kEncoderBits.
std::uint32_t left_count();
std::uint32_t right_count();

mcu::ResetReason take_reset_reason();
std::optional<mcu::Panic> take_panic();

/// STOP, for the enable input of a motor driver: high while the robot may drive, low from `start` on. A resistor of 10
/// k to ground holds it while the part is in reset.
void allow_motion(bool allowed);
/// Both motors ahead by so much of their power, 0 to 90. Once motion was not allowed they stand, until they were given
/// 0.
void drive_motors(std::int32_t percent);
/// The push button is down: `go`, and `stop` while the motors run.
bool button_held();
/// The light, if there is one, flashes once a second while the loop runs.
void feed_watchdog();
/// Sleeps until something may have happened: a byte, or a millisecond.
void idle();

}  // namespace fencepost::board
