// The board's side of the micro:bit v2's program, by another machine.
#include "hal/boards/microbit_v2/board.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/cortex_m/panic.hpp"
#include "tests/boards/mps2_an386/registers.hpp"

namespace fencepost::board {
namespace {

constinit Clock the_clock;
constinit Console console_line;
constinit Link camera_line;
// The serial line's are fixed.
struct NoPin {
  std::uint32_t number = 0;
  static void drive(bool /*high*/) {}
  static void make_output() {}
  static void make_input() {}
};
I2c no_bus{{}, {}};
constinit Flash the_flash;

}  // namespace

void start(std::uint32_t console_baud) {
  allow_motion(false);
  the_clock.start();
  console_line.start(NoPin{}, NoPin{}, console_baud);
}
void start_camera(std::uint32_t baud) { camera_line.start({}, {}, baud); }
void start_base(std::uint32_t baud) { start_camera(baud); }
void start_encoders() {}
void start_i2c() {}

Clock& clock() { return the_clock; }
Console& console() { return console_line; }
Link& camera() { return camera_line; }
Link& base() { return camera_line; }
I2c& i2c() { return no_bus; }
Flash& flash() { return the_flash; }
std::uint32_t left_count() { return 0; }
std::uint32_t right_count() { return 0; }

mcu::ResetReason take_reset_reason() { return mcu::ResetReason::kPowerOn; }
std::optional<mcu::Panic> take_panic() { return mcu::cortex_m::take_panic(); }

void allow_motion(bool allowed) { mcu::reg(test::mps2::kLights) = allowed ? 1 : 0; }
bool supply_low() { return false; }
void feed_watchdog() {}
void idle() {
  mcu::cortex_m::sleep_unless([] { return console_line.waiting() || camera_line.waiting(); });
}

}  // namespace fencepost::board

using namespace fencepost;

extern "C" {
void fencepost_hold_motors() { board::allow_motion(false); }
void systick_interrupt() {
  board::clock().on_interrupt();
  board::console().on_millisecond();
  board::camera().on_interrupt();  // the emulator drops one when a peer that had stopped reading starts again
}
void uart_interrupt() { board::console().on_interrupt(); }
void line_interrupt() { board::camera().on_interrupt(); }
}
