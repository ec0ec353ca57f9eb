#include "hal/boards/template/board.hpp"

namespace fencepost::board {
namespace {

Clock the_clock;
Link line{115'200};
I2c two_wire_bus;
Flash the_flash;

}  // namespace

void start(std::uint32_t /*console_baud*/) {}
void start_camera(std::uint32_t /*baud*/) {}
void start_base(std::uint32_t /*baud*/) {}
void start_i2c() {}
void start_encoders() {}
std::uint32_t left_count() { return 0; }
std::uint32_t right_count() { return 0; }

Clock& clock() { return the_clock; }
Link& console() { return line; }
Link& camera() { return line; }
Link& base() { return line; }
I2c& i2c() { return two_wire_bus; }
Flash& flash() { return the_flash; }

mcu::ResetReason take_reset_reason() { return mcu::ResetReason::kUnknown; }
std::optional<mcu::Panic> take_panic() { return std::nullopt; }

void allow_motion(bool /*allowed*/) {}
void feed_watchdog() {}
void idle() {}

}  // namespace fencepost::board

extern "C" {
[[noreturn]] void image_main();
}
// A real board's start-up does this; here it lets the desk link the image.
int main() { image_main(); }
