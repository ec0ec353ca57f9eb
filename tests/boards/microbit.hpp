// The micro:bit image in QEMU: one serial line. No emulator has a camera on its two-wire bus; frames go over the
// console.
#pragma once

#include "tests/boards/qemu.hpp"

namespace fencepost::test {

/// 15.6 million instructions a second: 1.02 cycles each, where the part needs some 1.4.
inline BoardUnderTest microbit(std::vector<std::string> more = {},
                               std::vector<std::string> configured = {"camera console"},
                               const std::string& started = "") {
  constexpr std::size_t kControl = 2;
  BoardUnderTest board;
  board.name = "microbit";
  board.configured = std::move(configured);
  board.lines = kControl + 1;  // and the emulator's own console, for its reset button
  board.command = [more = std::move(more), started](const std::vector<std::string>& sockets) {
    const QemuBoard qemu{"microbit", image_of("microbit") + ".elf", started, "timer_interrupt", 6, more};
    std::vector<std::string> words = qemu_command(qemu, sockets.at(kControl));
    words.insert(words.end(), {"-serial", "unix:" + sockets.at(0), "-monitor", "unix:" + sockets.at(1)});
    return words;
  };
  board.machine = emulated_qemu(kControl);
  return board;
}

}  // namespace fencepost::test
