// The STM32F405 image in QEMU: serial lines are USART1 (camera), USART2 (console), USART3 (base).
#pragma once

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

/// `image`: of its build folder.
inline BoardUnderTest f405(std::vector<std::string> more = {}, const std::string& image = "fencepost") {
  BoardUnderTest board;
  board.name = "f405";
  board.lines = 3;
  board.camera = 0;
  board.console = 1;
  board.command = [more = std::move(more), image](const std::vector<std::string>& sockets) {
    std::vector<std::string> words = {"qemu-system-arm", "-M",   "netduinoplus2", "-nographic",
                                      "-monitor",        "none", "-kernel",       image_of("f405", image) + ".elf"};
    for (const std::string& path : sockets) {
      words.insert(words.end(), {"-serial", "unix:" + path});
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  return board;
}

}  // namespace fencepost::test
