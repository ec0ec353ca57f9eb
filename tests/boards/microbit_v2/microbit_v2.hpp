// The micro:bit v2's program in QEMU, on another machine with its core (tests/boards/mps2_an386): one serial line.
// Frames go over the console.
#pragma once

#include "tests/boards/qemu.hpp"

namespace fencepost::test {

inline constexpr const char* kMicrobitV2OnMps2 = "fencepost-mps2_an386";

/// 62.5 million instructions a second: 1.02 cycles each, where the part needs some 1.4.
inline BoardUnderTest microbit_v2(std::vector<std::string> more = {}) {
  constexpr std::size_t kControl = 1;
  BoardUnderTest board;
  board.name = "microbit_v2";
  board.told = {"camera console"};
  board.lines = kControl + 1;
  board.command = [more = std::move(more)](const std::vector<std::string>& sockets) {
    const QemuBoard qemu{"mps2-an386", image_of("microbit_v2", kMicrobitV2OnMps2) + ".elf", "", "systick_interrupt", 4,
                         more};
    std::vector<std::string> words = qemu_command(qemu, sockets.at(kControl));
    words.insert(words.end(), {"-monitor", "none", "-serial", "unix:" + sockets.at(0)});
    return words;
  };
  board.machine = emulated_qemu(kControl);
  return board;
}

}  // namespace fencepost::test
