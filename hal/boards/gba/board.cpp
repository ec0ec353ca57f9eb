#include "hal/boards/gba/board.hpp"

#include "hal/mcu/about_board.hpp"
#include "hal/mcu/gba/interrupts.hpp"
#include "hal/mcu/gba/registers.hpp"

namespace fencepost::board {
namespace {

namespace part = mcu::gba;

[[gnu::used, gnu::section(".about")]] constexpr mcu::AboutBoard kAbout =
    mcu::about_board(kTarget, 0x0800'0000, Flash::kAddress, Flash::size());

Clock the_clock;
Link console_line;
Flash the_sram;
Screen the_screen;

}  // namespace

extern "C" {
void gba_interrupt();
}
// The BIOS calls this in ARM state 4096 times a second, so it is placed in fast memory.
[[gnu::target("arm"), gnu::section(".fast")]] void gba_interrupt() {
  const std::uint16_t which = part::take_interrupts();
  if ((which & part::kInterruptTimer2) != 0) {
    the_clock.tick();
    the_screen.tick();
  }
  console_line.serve();
}

void start(std::uint32_t console_baud) {
  mcu::reg16(part::kWaitControl) = part::kWaits;
  part::start_interrupts(gba_interrupt);
  the_clock.start();
  console_line.start(console_baud);
  the_screen.start();
  the_sram.start();
}

Clock& clock() { return the_clock; }
Link& console() { return console_line; }
Flash& flash() { return the_sram; }
Screen& screen() { return the_screen; }

bus::Buttons buttons() {
  const std::uint16_t released = mcu::reg16(part::kKeys);  // A, B, SELECT, START are bits 0 to 3
  const auto held = [released](unsigned bit) { return ((released >> bit) & 1U) == 0; };
  return {held(3), held(2), held(0), held(1)};
}

void idle() {
  static constinit std::uint32_t last = 0;
  while (last == the_clock.milliseconds() && !console_line.waiting()) {
    part::sleep_unless([] { return last != the_clock.milliseconds() || console_line.waiting(); });
  }
  last = the_clock.milliseconds();
}

}  // namespace fencepost::board
