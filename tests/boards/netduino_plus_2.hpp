// The Netduino Plus 2's image in QEMU. Its serial lines are USART1 to 3, UART4 and 5, USART6. The console is the
// second, the base the fourth, the camera the sixth.
#pragma once

#include "tests/boards/qemu.hpp"

namespace fencepost::test {

/// `configured`: settings that are typed first; `started`: another .bin than the image. 125 million instructions a
/// second are 1.34 cycles each.
inline BoardUnderTest netduino_plus_2(std::vector<std::string> more = {}, std::vector<std::string> configured = {},
                                      const std::string& started = "") {
  constexpr std::size_t kControl = 6;
  BoardUnderTest board;
  board.name = "netduino_plus_2";
  board.lines = kControl + 1;
  board.camera = 5;
  board.console = 1;
  board.configured = std::move(configured);
  board.command = [more = std::move(more), started](const std::vector<std::string>& sockets) {
    const QemuBoard qemu{"netduinoplus2", image_of("netduino_plus_2") + ".elf", started, "systick_interrupt", 3, more};
    std::vector<std::string> words = qemu_command(qemu, sockets.at(kControl));
    words.insert(words.end(), {"-monitor", "none"});
    for (std::size_t n = 0; n < kControl; ++n) words.insert(words.end(), {"-serial", "unix:" + sockets.at(n)});
    return words;
  };
  board.machine = emulated_qemu(kControl);
  return board;
}

}  // namespace fencepost::test
