#include "hal/boards/netduino_plus_2/board.hpp"

#include "hal/mcu/about_board.hpp"
#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/cortex_m/panic.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/registers.hpp"
#include "hal/mcu/stm32f4/reset_reason.hpp"
#include "hal/mcu/stm32f4/supply.hpp"
#include "hal/mcu/stm32f4/watchdog.hpp"
#include FENCEPOST_PINS

// Compiled once for each board with this part; FENCEPOST_PINS is the board's pins.hpp, FENCEPOST_BOARD_NAME its folder.
namespace fencepost::board {

using FENCEPOST_BOARD_NAME::kWiring;

constinit const std::string_view kTarget = kWiring.target;
constinit const bus::PinNames kPinNames = kWiring.names;

namespace {

namespace part = mcu::stm32f4;

constexpr std::uint32_t kFlash = 0x0800'0000;  // of the vectors (image.ld)
[[gnu::used, gnu::section(".about")]] constexpr mcu::AboutBoard kAbout =
    mcu::about_board(kWiring.target, kFlash, Flash::kAddress, Flash::size());

part::Clocks clocks;
Clock the_clock;
constinit Link console_line;
constinit Link camera_line;
constinit Link base_line;
I2c the_bus{kWiring.i2c_clock, kWiring.i2c_data};
constinit Flash the_flash;
constexpr part::Encoder kLeft{kWiring.left};
constexpr part::Encoder kRight{kWiring.right};

/// The line that this board has on the part's serial line.
template <const part::UartPart& kPart>
void serial_interrupt() {
  if constexpr (kWiring.console.part.base == kPart.base) console_line.on_interrupt();
  if constexpr (kWiring.camera.part.base == kPart.base) camera_line.on_interrupt();
  if constexpr (kWiring.base.part.base == kPart.base) base_line.on_interrupt();
}

}  // namespace

void start(std::uint32_t console_baud) {
  part::feed_watchdog();  // it may run already: nothing but power stops it
  clocks = part::start_clocks(kWiring.crystals);
  part::watch_supply();
  kWiring.stop.make_output(false);
  part::start_watchdog();
  if (kWiring.power) kWiring.power->make_output(true);
  kWiring.light.make_output(false);
  the_clock.start(clocks.timer);
  console_line.start(kWiring.console, clocks, console_baud);
  mcu::cortex_m::start_ticks(clocks.core);
}

void start_camera(std::uint32_t baud) { camera_line.start(kWiring.camera, clocks, baud); }
void start_base(std::uint32_t baud) { base_line.start(kWiring.base, clocks, baud); }
void start_encoders() {
  kLeft.start();
  kRight.start();
}
void start_i2c() { the_bus.start(clocks.apb1); }

Clock& clock() { return the_clock; }
Link& console() { return console_line; }
Link& camera() { return camera_line; }
Link& base() { return base_line; }
I2c& i2c() { return the_bus; }
Flash& flash() { return the_flash; }
std::uint32_t left_count() { return kLeft.count(); }
std::uint32_t right_count() { return kRight.count(); }

mcu::ResetReason take_reset_reason() { return part::take_reset_reason(); }
std::optional<mcu::Panic> take_panic() { return mcu::cortex_m::take_panic(); }

void allow_motion(bool allowed) { kWiring.stop.drive(allowed); }
bool supply_low() { return part::supply_low(); }
void feed_watchdog() {
  part::feed_watchdog();
  constexpr std::uint32_t kFlash = 0xF'0000;  // us: 65 ms of each 1.05 s
  kWiring.light.drive((Clock::microseconds() & kFlash) == 0);
}
void idle() {
  mcu::cortex_m::sleep_unless([] { return console_line.waiting() || camera_line.waiting() || base_line.waiting(); });
}

}  // namespace fencepost::board

using namespace fencepost;

extern "C" {
void fencepost_hold_motors() { board::allow_motion(false); }
void systick_interrupt() {
  board::console().on_millisecond();
  board::camera().on_millisecond();
  board::base().on_millisecond();
  board::i2c().on_millisecond();
}
void i2c1_event_interrupt() { board::i2c().on_event(); }
void i2c1_error_interrupt() { board::i2c().on_error(); }
void usart1_interrupt() { board::serial_interrupt<board::part::kUsart1Part>(); }
void usart2_interrupt() { board::serial_interrupt<board::part::kUsart2Part>(); }
void usart3_interrupt() { board::serial_interrupt<board::part::kUsart3Part>(); }
void uart4_interrupt() { board::serial_interrupt<board::part::kUart4Part>(); }
void usart6_interrupt() { board::serial_interrupt<board::part::kUsart6Part>(); }
}
