// The micro:bit image in QEMU: one serial line. No emulator has a camera on its two-wire bus; frames go over the
// console.
#pragma once

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

inline BoardUnderTest microbit(const std::string& image = "microbit-console", std::vector<std::string> more = {}) {
  BoardUnderTest board;
  board.name = image;
  board.lines = 2;  // and the emulator's own console, for its reset button
  board.command = [image, more = std::move(more)](const std::vector<std::string>& sockets) {
    std::vector<std::string> words = {"qemu-system-arm", "-M",
                                      "microbit",        "-nographic",
                                      "-kernel",         image_of(image) + ".elf",
                                      "-serial",         "unix:" + sockets.at(0),
                                      "-monitor",        "unix:" + sockets.at(1)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  return board;
}

}  // namespace fencepost::test
