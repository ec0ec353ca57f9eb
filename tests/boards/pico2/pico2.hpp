// The Pico 2's program in QEMU, on another machine with its core (tests/boards/mps2_an505): the console is the first
// serial line, the camera the second.
#pragma once

#include "tests/boards/qemu.hpp"

namespace fencepost::test {

inline constexpr const char* kPico2OnMps2 = "fencepost-mps2_an505";

/// 125 million instructions a second: 1.2 cycles each.
inline BoardUnderTest pico2(std::vector<std::string> more = {}) {
  constexpr std::size_t kControl = 2;
  BoardUnderTest board;
  board.name = "pico2";
  board.lines = kControl + 1;
  board.console = 0;
  board.camera = 1;
  board.command = [more = std::move(more)](const std::vector<std::string>& sockets) {
    const QemuBoard qemu{"mps2-an505", image_of("pico2", kPico2OnMps2) + ".elf", "", "systick_interrupt", 3, more};
    std::vector<std::string> words = qemu_command(qemu, sockets.at(kControl));
    words.insert(words.end(), {"-monitor", "none"});
    for (std::size_t n = 0; n < kControl; ++n) words.insert(words.end(), {"-serial", "unix:" + sockets.at(n)});
    return words;
  };
  board.machine = emulated_qemu(kControl);
  return board;
}

}  // namespace fencepost::test
