// A board that does nothing: what every board has to provide, to start a new one from. Compiled on the desk so that it
// stays valid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/bus/flash_pages.hpp"
#include "hal/mcu/reset.hpp"
#include "hal/template/clock.hpp"
#include "hal/template/i2c_master.hpp"
#include "hal/template/uart.hpp"

namespace fencepost::board {

/// In the header of each log.
inline constexpr std::string_view kTarget = "template";

/// Fill in: a bus::Clock that can tell microseconds, too.
struct Clock : port::BoardClock {
  /// Wraps.
  [[nodiscard]] std::uint32_t microseconds() const { return static_cast<std::uint32_t>(now().raw) * 100; }
};
/// Fill in: a bus::ByteLink. Where lines are of several kinds (USB and a UART), a type for each.
using Link = port::Uart;
/// Fill in where the board has an I2C bus for a camera. FENCEPOST_DEVICES in its CMakeLists.txt says which devices the
/// image contains; what else a board may say of itself: firmware/image/unsaid.hpp, hal/mcu/about_board.hpp.
using I2c = port::I2cMaster;

/// Fill in: two pages that the linker script leaves free. A part without such flash keeps nothing: like this.
struct Flash {
  [[nodiscard]] static std::size_t size() { return 0; }
  [[nodiscard]] static std::span<const std::uint8_t> page(std::size_t /*n*/) { return {}; }
  static bool program(std::size_t /*n*/, std::size_t /*offset*/, std::span<const std::uint8_t> /*bytes*/) {
    return false;
  }
  static bool erase(std::size_t /*n*/) { return false; }
};
static_assert(bus::FlashPages<Flash>);

/// Fill in: clocks, timer, watchdog, console; nothing else here is called before.
void start(std::uint32_t console_baud);
/// Fill in: called before the respective link is used, if it is used at all.
void start_camera(std::uint32_t baud);
void start_base(std::uint32_t baud);
void start_i2c();
/// Fill in where the board can count wheels.
void start_encoders();
std::uint32_t left_count();
std::uint32_t right_count();

Clock& clock();
Link& console();
Link& camera();
Link& base();
I2c& i2c();
Flash& flash();

/// Fill in: called once after the start; later calls need not remember it.
mcu::ResetReason take_reset_reason();
std::optional<mcu::Panic> take_panic();

/// Fill in: STOP, an output for the enable input of a motor driver. High while the robot may drive, low from `start` on
/// and in a panic (hal/mcu/*/panic.hpp). Where the board has no pin for it, nothing.
void allow_motion(bool allowed);
// A board that drives two motors says `kMotors` and has `drive_motors`, as hal/boards/pico/board.hpp; others need not.
/// Fill in: the loop calls it after each turn that did its work. It bites after 0.3 to 0.5 s without.
void feed_watchdog();
/// Fill in: sleep until a byte comes or a millisecond is over, unless a byte waits already.
void idle();

}  // namespace fencepost::board
