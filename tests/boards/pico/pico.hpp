// The Raspberry Pi Pico's image in its emulator: serial lines are UART0 (console), UART1 (camera), USB (console, too).
#pragma once

#include <memory>

#include "tests/boards/pico/machine.hpp"

namespace fencepost::test {

/// `seen`, if not null, is where the machine will be while the bench has it. `image`: of its build folder, or a path.
/// `counts`: what to count (tests/boards/counting.hpp), or nothing.
inline BoardUnderTest pico(EmulatedPico** seen = nullptr, const std::string& image = "fencepost",
                           const std::string& counts = "") {
  BoardUnderTest board;
  board.name = "pico";
  board.lines = EmulatedPico::kLines;
  board.console = EmulatedPico::kConsole;
  board.camera = EmulatedPico::kCamera;
  board.command = [image, counts](const std::vector<std::string>& sockets) {
    std::vector<std::string> words = {FENCEPOST_NODE, FENCEPOST_PICO_EMULATOR, image_of("pico", image) + ".uf2"};
    words.insert(words.end(), sockets.begin(), sockets.end());
    if (!counts.empty()) words.push_back(counts);
    return words;
  };
  board.machine = [seen](const BoardUnderTest& one) {
    auto machine = std::make_unique<EmulatedPico>(one);
    if (seen != nullptr) *seen = machine.get();
    return machine;
  };
  return board;
}

}  // namespace fencepost::test
