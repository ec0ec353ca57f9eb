// The board of the Pico 2's program, by another machine. It has no USB, no two-wire bus, no wheels: the
// classes for them are the board's own, and are never started.
#include "hal/boards/pico/board.hpp"

#include "hal/boards/pico2/pins.hpp"
#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/cortex_m/panic.hpp"
#include "tests/boards/mps2_an386/line.hpp"

namespace fencepost::board {

constinit const std::string_view kTarget = pico2::kWiring.target;
constinit const bus::PinNames kPinNames = pico2::kWiring.names;

namespace {

namespace machine = test::mps2;

constexpr std::uint32_t kMayDrive = 1U << 0;  // of the lights
constexpr std::uint32_t kDrives = 1U << 1;

Clock the_clock;
constinit Link console_line;
constinit mcu::rp2::UsbSerial no_usb;
constinit Console the_console{console_line, no_usb};
constinit Link camera_line;
constinit I2c no_bus;
constinit Flash the_flash;

mcu::rp2::UartWiring line(std::uint32_t n) { return {machine::uart(n), 0, machine::interrupt_of_uart(n), {}, {}}; }

}  // namespace

void start(std::uint32_t console_baud) {
  allow_motion(false);
  the_clock.start(machine::kCoreHz);
  console_line.start(line(0), machine::kCoreHz, console_baud);
}
void start_camera(std::uint32_t baud) { camera_line.start(line(1), machine::kCoreHz, baud); }
void start_base(std::uint32_t baud) { start_camera(baud); }
void start_encoders() {}
void start_i2c() {}

Clock& clock() { return the_clock; }
Console& console() { return the_console; }
Link& camera() { return camera_line; }
Link& base() { return camera_line; }
I2c& i2c() { return no_bus; }
Flash& flash() { return the_flash; }
std::uint32_t left_count() { return 0; }
std::uint32_t right_count() { return 0; }

mcu::ResetReason take_reset_reason() { return mcu::ResetReason::kPowerOn; }
std::optional<mcu::Panic> take_panic() { return mcu::cortex_m::take_panic(); }

void allow_motion(bool allowed) { mcu::reg(machine::kLights) = allowed ? kMayDrive : 0; }
void drive_motors(std::int32_t percent) { mcu::reg(machine::kLights) = percent == 0 ? kMayDrive : kMayDrive | kDrives; }
bool button_held() { return false; }
void feed_watchdog() {}
void idle() {
  mcu::cortex_m::sleep_unless([] { return console_line.waiting() || camera_line.waiting(); });
}

}  // namespace fencepost::board

using namespace fencepost;

extern "C" {
void fencepost_hold_motors() { board::allow_motion(false); }
void systick_interrupt() {
  board::clock().tick();
  board::console_line.on_interrupt();  // the emulator drops one when a peer that had stopped reading starts again
  board::camera_line.on_interrupt();
}
void uart0_interrupt() { board::console_line.on_interrupt(); }
void uart1_interrupt() { board::camera_line.on_interrupt(); }
}
