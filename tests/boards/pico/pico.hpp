// The Raspberry Pi Pico's image in its emulator: serial lines are UART0 (console), UART1 (camera), USB (console, too),
// and the control line of an emulator that has a time of its own.
#pragma once

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

inline constexpr std::size_t kPicoUsb = 2;

/// `image`: the file's name. `counts`: what to count (tests/boards/counting.hpp), or nothing.
inline BoardUnderTest pico(const std::string& image = "fencepost", const std::string& counts = "") {
  BoardUnderTest board;
  board.name = "pico";
  board.lines = 4;
  board.console = 0;
  board.camera = 1;
  board.control = 3;
  board.command = [image, counts](const std::vector<std::string>& sockets) {
    std::vector<std::string> words = {"node", FENCEPOST_PICO_EMULATOR, FENCEPOST_IMAGES_DIR "/pico/" + image + ".uf2"};
    words.insert(words.end(), sockets.begin(), sockets.end());
    if (!counts.empty()) words.push_back(counts);
    return words;
  };
  return board;
}

}  // namespace fencepost::test
