// The micro:bit v2's program in QEMU, on another machine with its core (tests/boards/mps2_an386). The console is the
// first serial line, a camera or a wheel base on the second.
#pragma once

#include "tests/boards/qemu.hpp"

namespace fencepost::test {

inline constexpr const char* kMicrobitV2OnMps2 = "fencepost-mps2_an386";

inline constexpr int kMicrobitV2Line = 1;

/// 62.5 million instructions a second: 1.02 cycles each, where the part needs some 1.4. Frames go over the console.
inline BoardUnderTest microbit_v2(std::vector<std::string> more = {}) {
  constexpr std::size_t kControl = 2;
  BoardUnderTest board;
  board.name = "microbit_v2";
  board.configured = {"camera console"};
  board.lines = kControl + 1;
  board.command = [more = std::move(more)](const std::vector<std::string>& sockets) {
    const QemuBoard qemu{"mps2-an386", image_of("microbit_v2", kMicrobitV2OnMps2) + ".elf", "", "systick_interrupt", 4,
                         more};
    std::vector<std::string> words = qemu_command(qemu, sockets.at(kControl));
    words.insert(words.end(), {"-monitor", "none"});
    for (std::size_t n = 0; n < kControl; ++n) words.insert(words.end(), {"-serial", "unix:" + sockets.at(n)});
    return words;
  };
  board.machine = emulated_qemu(kControl);
  return board;
}

}  // namespace fencepost::test
