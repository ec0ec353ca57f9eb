// An emulated Pico: emulate.mjs as a child process, whose time passes only on command.
#pragma once

#include <string>

#include "tests/boards/stepped.hpp"

namespace fencepost::test {

class EmulatedPico : public SteppedEmulator {
 public:
  static constexpr std::size_t kConsole = 0;
  static constexpr std::size_t kCamera = 1;
  static constexpr std::size_t kUsb = 2;
  static constexpr std::size_t kControl = 3;
  static constexpr std::size_t kLines = 4;

  explicit EmulatedPico(const BoardUnderTest& board);

  void pump() override;

  /// A word on its control line (emulate.mjs says which).
  void command(const std::string& line);
  /// And what it answers. Throws std::runtime_error if it has ended.
  std::string ask(const std::string& line);
};

}  // namespace fencepost::test
