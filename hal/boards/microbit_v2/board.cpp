#include "hal/boards/microbit_v2/board.hpp"

#include "hal/boards/microbit_v2/pins.hpp"
#include "hal/mcu/about_board.hpp"
#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/cortex_m/panic.hpp"
#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/nrf51/watchdog.hpp"
#include "hal/mcu/nrf52/encoder.hpp"
#include "hal/mcu/nrf52/registers.hpp"
#include "hal/mcu/nrf52/reset_reason.hpp"
#include "hal/mcu/nrf52/start.hpp"
#include "hal/mcu/nrf52/supply.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::board {
namespace {

namespace part = mcu::nrf51;

[[gnu::used, gnu::section(".about")]] constexpr mcu::AboutBoard kAbout =
    mcu::about_board(kTarget, 0, Flash::kAddress, Flash::size());

constexpr unsigned kHalfASecond = 19;  // 2^19 us

constexpr std::uint32_t kMaxPolls =
    100'000;  // the crystal starts within a millisecond (CLOCK, electrical specification)

constinit Clock the_clock;
constinit Console console_line;
constinit Link camera_line;
I2c the_bus{microbit_v2::kBusClock, microbit_v2::kBusData};
constinit Flash the_flash;
constinit mcu::nrf52::Encoder left;
constinit mcu::nrf52::Encoder right;

void start_lights() {
  for (const mcu::nrf52::Pin column : microbit_v2::kDarkColumns) {
    column.drive(true);
    column.make_output();
  }
  microbit_v2::kLitColumn.drive(false);
  microbit_v2::kLitColumn.make_output();
  microbit_v2::kHeartbeatRow.drive(false);
  microbit_v2::kHeartbeatRow.make_output();
  microbit_v2::kHeldRow.make_output();
}

}  // namespace

void start(std::uint32_t console_baud) {
  allow_motion(false);
  microbit_v2::kStop.make_output();
  mcu::nrf52::start_part();
  mcu::nrf52::connect_reset_pin(microbit_v2::kReset.number);
  // The built-in oscillator is accurate to 1.5 to 8 %, too coarse for a serial line. Where no crystal starts it is used
  // nevertheless.
  mcu::reg(part::kStartCrystal) = part::kTrigger;
  static_cast<void>(mcu::await_bits(part::kCrystalStarted, 1, kMaxPolls));
  the_clock.start();
  mcu::nrf52::watch_supply();
  part::start_watchdog();
  part::feed_watchdog();  // one that a reset by software left running is not started again
  console_line.start(microbit_v2::kConsoleSends, microbit_v2::kConsoleReceives, console_baud);
  start_lights();
}

void start_camera(std::uint32_t baud) { camera_line.start(microbit_v2::kLineSends, microbit_v2::kLineReceives, baud); }
void start_base(std::uint32_t baud) { start_camera(baud); }
void start_encoders() {
  left.start(microbit_v2::kLeftA, microbit_v2::kLeftB, 0);
  right.start(microbit_v2::kRightA, microbit_v2::kRightB, 2);
}
void start_i2c() { the_bus.start(); }

Clock& clock() { return the_clock; }
Console& console() { return console_line; }
Link& camera() { return camera_line; }
Link& base() { return camera_line; }
I2c& i2c() { return the_bus; }
Flash& flash() { return the_flash; }
std::uint32_t left_count() { return left.count(); }
std::uint32_t right_count() { return right.count(); }

mcu::ResetReason take_reset_reason() { return mcu::nrf52::take_reset_reason(); }
std::optional<mcu::Panic> take_panic() { return mcu::cortex_m::take_panic(); }

void allow_motion(bool allowed) {
  microbit_v2::kStop.drive(allowed);
  microbit_v2::kHeldRow.drive(!allowed);
}
bool supply_low() { return mcu::nrf52::supply_low(); }
void feed_watchdog() {
  part::feed_watchdog();
  microbit_v2::kHeartbeatRow.drive((the_clock.microseconds() >> kHalfASecond & 1U) != 0);
}
void idle() {
  mcu::cortex_m::sleep_unless([] { return console_line.waiting() || camera_line.waiting(); });
}

}  // namespace fencepost::board

using namespace fencepost;

extern "C" {
void fencepost_hold_motors() { board::allow_motion(false); }
void timer_interrupt() {
  board::clock().on_interrupt();
  board::console().on_millisecond();
  board::i2c().on_millisecond();
}
void uart_interrupt() { board::console().on_interrupt(); }
void line_interrupt() { board::camera().on_interrupt(); }
void edge_interrupt() {
  board::left.on_interrupt();
  board::right.on_interrupt();
}
void twi_interrupt() { board::i2c().on_interrupt(); }
}
