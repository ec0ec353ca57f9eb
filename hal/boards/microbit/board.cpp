#include "hal/boards/microbit/board.hpp"

#include "hal/boards/microbit/pins.hpp"
#include "hal/mcu/about_board.hpp"
#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/cortex_m/panic.hpp"
#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/nrf51/reset_reason.hpp"
#include "hal/mcu/nrf51/watchdog.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::board {
namespace {

namespace part = mcu::nrf51;

using microbit::kBusClock;
using microbit::kBusData;
using microbit::kConsoleReceives;
using microbit::kConsoleSends;
using microbit::kFirstRow;
using microbit::kStop;

[[gnu::used, gnu::section(".about")]] constexpr mcu::AboutBoard kAbout =
    mcu::about_board(kTarget, 0, Flash::kAddress, Flash::size());

constexpr unsigned kHalfASecond = 19;  // 2^19 us

constexpr std::uint32_t kMaxPolls = 100'000;  // the crystal starts within 1 ms (product specification)

constinit Clock the_clock;
constinit Link console_line;
I2c the_bus{kBusClock, kBusData};
constinit Flash the_flash;

void start_led() {
  kFirstRow.drive(false);
  kFirstRow.make_output();
  for (std::uint32_t i = 0; i < microbit::kColumns; ++i) {
    const part::Pin column{microbit::kFirstColumn + i};
    column.drive(i != 0);
    column.make_output();
  }
}

}  // namespace

void start(std::uint32_t console_baud) {
  kStop.drive(false);
  kStop.make_output();
  // The built-in oscillator is accurate to 1 to 5 %, too coarse for a serial line. Where no crystal starts it is used
  // nevertheless.
  mcu::reg(part::kStartCrystal) = part::kTrigger;
  static_cast<void>(mcu::await_bits(part::kCrystalStarted, 1, kMaxPolls));
  the_clock.start();
  part::start_watchdog();
  console_line.start(kConsoleSends, kConsoleReceives, console_baud);
  start_led();
}

void start_i2c() { the_bus.start(); }

Clock& clock() { return the_clock; }
Link& console() { return console_line; }
I2c& i2c() { return the_bus; }
Flash& flash() { return the_flash; }

mcu::ResetReason take_reset_reason() { return part::take_reset_reason(); }
std::optional<mcu::Panic> take_panic() { return mcu::cortex_m::take_panic(); }

void allow_motion(bool allowed) { kStop.drive(allowed); }
void feed_watchdog() {
  part::feed_watchdog();
  kFirstRow.drive((the_clock.microseconds() >> kHalfASecond & 1U) != 0);
}
void idle() {
  mcu::cortex_m::sleep_unless([] { return console_line.waiting(); });
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
void twi_interrupt() { board::i2c().on_interrupt(); }
}
