// The Game Boy Advance image in libmgba: the console is the mailbox, and the camera's frames come over it.
#pragma once

#include <memory>

#include "tests/boards/gba/handheld.hpp"

namespace fencepost::test {

/// `seen`, if not null, is where the machine will be while the bench has it.
inline BoardUnderTest gba(Handheld** seen = nullptr, std::vector<std::uint8_t>* save = nullptr,
                          Handheld::Console console = Handheld::Console::kMailbox) {
  BoardUnderTest board;
  board.name = "gba";
  board.machine = [seen, save, console](const BoardUnderTest& /*board*/) {
    auto machine = std::make_unique<Handheld>(image_of("gba") + ".gba", save, console);
    if (seen != nullptr) *seen = machine.get();
    return machine;
  };
  return board;
}

}  // namespace fencepost::test
