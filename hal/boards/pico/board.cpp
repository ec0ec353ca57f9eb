#include "hal/boards/pico/board.hpp"

#include "hal/mcu/about_board.hpp"
#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/rp2/clocks.hpp"
#include "hal/mcu/rp2/panic.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "hal/mcu/rp2/reset_reason.hpp"
#include "hal/mcu/rp2/unique_id.hpp"
#include "hal/mcu/rp2/watchdog.hpp"
#include FENCEPOST_PINS

// Compiled once for each board with this part; FENCEPOST_PINS is the board's pins.hpp, FENCEPOST_BOARD_NAME its folder.
namespace fencepost::board {

using FENCEPOST_BOARD_NAME::kWiring;

constinit const std::string_view kTarget = kWiring.target;
constinit const bus::PinNames kPinNames = kWiring.names;

namespace {

namespace part = mcu::rp2;

[[gnu::used, gnu::section(".about")]] constexpr mcu::AboutBoard kAbout =
    mcu::about_board(kWiring.target, part::kFlashBase, Flash::kAddress, Flash::size());

part::Clocks clocks;
mcu::ResetReason reason;
Clock the_clock;
constinit part::Uart console_line;
constinit part::UsbSerial usb_line;
constinit Console the_console{console_line, usb_line};
constinit Link camera_line;
constexpr bool kCameraIsFirst = kWiring.camera.base == part::kUart0;  // of the part's two UARTs

constinit Link& first_line = kCameraIsFirst ? camera_line : console_line;
constinit Link& second_line = kCameraIsFirst ? console_line : camera_line;
constinit I2c the_i2c;
constinit Flash the_flash;
constinit part::Encoder left;
constinit part::Encoder right;
constinit part::Motors motors{kWiring.left_motor, kWiring.right_motor};
bool motors_free = false;

}  // namespace

void start(std::uint32_t console_baud) {
  kWiring.stop.drive(false);  // a debugger that resets the core alone leaves the pins
  clocks = part::start_clocks();
  part::bring_up(part::kResetIoBank0 | part::kResetPadsBank0);
  kWiring.stop.make_output();
  motors.start(clocks.core);
  the_clock.start(clocks.reference);
  reason = part::read_reset_reason();
  part::start_watchdog();
  kWiring.button.connect(part::kFunctionSoftware);
  if (kWiring.light) kWiring.light->make_output();
  if (kWiring.console) console_line.start(*kWiring.console, clocks.core, console_baud);
  if (clocks.usb) usb_line.start(part::read_unique_id());
}

void start_camera(std::uint32_t baud) { camera_line.start(kWiring.camera, clocks.core, baud); }
void start_base(std::uint32_t baud) { start_camera(baud); }
void start_i2c() { the_i2c.start(kWiring.i2c, clocks.core); }
void start_encoders() {
  left.start(kWiring.left.a, kWiring.left.b);
  right.start(kWiring.right.a, kWiring.right.b);
  mcu::cortex_m::enable_interrupt(part::kInterruptPins);
}

Clock& clock() { return the_clock; }
Console& console() { return the_console; }
Link& camera() { return camera_line; }
Link& base() { return camera_line; }
I2c& i2c() { return the_i2c; }
Flash& flash() { return the_flash; }
std::uint32_t left_count() { return left.count() & 0xFFFFU; }
std::uint32_t right_count() { return right.count() & 0xFFFFU; }

mcu::ResetReason take_reset_reason() { return reason; }
std::optional<mcu::Panic> take_panic() { return part::take_panic(); }

void allow_motion(bool allowed) {
  kWiring.stop.drive(allowed);
  if (allowed) return;
  motors.stop();
  motors_free = false;
}
void drive_motors(std::int32_t percent) {
  if (percent == 0) motors_free = true;
  motors.ahead(motors_free ? percent : 0);
}
bool button_held() { return !kWiring.button.high(); }
void feed_watchdog() {
  part::feed_watchdog();
  constexpr std::uint32_t kFlash = 0xF'0000;  // us: 65 ms of each 1.05 s
  if (kWiring.light) kWiring.light->drive((the_clock.microseconds() & kFlash) == 0);
}
void idle() {
  if (usb_line.take_loader_wanted()) {
    allow_motion(false);
    part::start_boot_loader();
  }
  mcu::cortex_m::sleep_unless([] { return console_line.waiting() || usb_line.waiting() || camera_line.waiting(); });
}

}  // namespace fencepost::board

using namespace fencepost;

extern "C" {
void fencepost_hold_motors() { board::allow_motion(false); }
void timer_interrupt() { board::clock().tick(); }
void usb_interrupt() { board::usb_line.on_interrupt(); }
void pins_interrupt() {
  board::left.on_interrupt();
  board::right.on_interrupt();
}
void uart0_interrupt() { board::first_line.on_interrupt(); }
void uart1_interrupt() { board::second_line.on_interrupt(); }
void i2c_interrupt() { board::i2c().on_interrupt(); }
}
