#include "hal/boards/f405/board.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/cortex_m/panic.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/registers.hpp"
#include "hal/mcu/stm32f4/reset_reason.hpp"
#include "hal/mcu/stm32f4/watchdog.hpp"

namespace fencepost::board {
namespace {

namespace part = mcu::stm32f4;

constexpr part::UartWiring kConsole = {
    part::kUsart2, part::kRccApb1Enable, 1U << 17, part::kInterruptUsart2, 7, {'A', 2}, {'A', 3}};
constexpr part::UartWiring kCamera = {part::kUsart1, part::kRccApb2Enable, 1U << 4, part::kInterruptUsart1, 7, {'A', 9},
                                      {'A', 10}};
constexpr part::UartWiring kBase = {part::kUsart3, part::kRccApb1Enable, 1U << 18, part::kInterruptUsart3, 7, {'B', 10},
                                    {'B', 11}};

part::Clocks clocks;
Clock the_clock;
constinit Link console_line;
constinit Link camera_line;
constinit Link base_line;
I2c the_bus{{'B', 8}, {'B', 9}};
constinit Flash the_flash;
constexpr part::Encoder kLeft{part::kTimer3, 1U << 1, {'A', 6}, {'A', 7}};
constexpr part::Encoder kRight{part::kTimer4, 1U << 2, {'B', 6}, {'B', 7}};

}  // namespace

void start(std::uint32_t console_baud) {
  clocks = part::start_clocks();
  the_clock.start(clocks.core);
  part::start_watchdog();
  console_line.start(kConsole, clocks.apb1, console_baud);
}

void start_camera(std::uint32_t baud) { camera_line.start(kCamera, clocks.apb2, baud); }
void start_base(std::uint32_t baud) { base_line.start(kBase, clocks.apb1, baud); }
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

void feed_watchdog() { part::feed_watchdog(); }
void idle() {
  mcu::cortex_m::sleep_unless([] { return console_line.waiting() || camera_line.waiting() || base_line.waiting(); });
}

}  // namespace fencepost::board

using namespace fencepost;

extern "C" {
void systick_interrupt() {
  board::clock().tick();
  board::console().on_millisecond();
  board::camera().on_millisecond();
  board::base().on_millisecond();
  board::i2c().on_millisecond();
}
void i2c1_event_interrupt() { board::i2c().on_event(); }
void i2c1_error_interrupt() { board::i2c().on_error(); }
void usart1_interrupt() { board::camera().on_interrupt(); }
void usart2_interrupt() { board::console().on_interrupt(); }
void usart3_interrupt() { board::base().on_interrupt(); }
}
