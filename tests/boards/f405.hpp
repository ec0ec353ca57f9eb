// The STM32F405 image in QEMU: serial lines are USART1 (camera), USART2 (console), USART3 (base).
#pragma once

#include "tests/boards/qemu.hpp"

namespace fencepost::test {

/// `image`: of its build folder. 125 million instructions a second are 1.34 cycles each.
inline BoardUnderTest f405(std::vector<std::string> more = {}, const std::string& image = "fencepost") {
  constexpr std::size_t kControl = 3;
  BoardUnderTest board;
  board.name = "f405";
  board.lines = kControl + 1;
  board.camera = 0;
  board.console = 1;
  board.command = [more = std::move(more), image](const std::vector<std::string>& sockets) {
    const QemuBoard qemu{"netduinoplus2", image_of("f405", image) + ".elf", "systick_interrupt", 3, more};
    std::vector<std::string> words = qemu_command(qemu, sockets.at(kControl));
    words.insert(words.end(), {"-monitor", "none"});
    for (std::size_t n = 0; n < kControl; ++n) words.insert(words.end(), {"-serial", "unix:" + sockets.at(n)});
    return words;
  };
  board.machine = emulated_qemu(kControl);
  return board;
}

}  // namespace fencepost::test
