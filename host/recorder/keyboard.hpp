// Standard input on its way to the robot's console: a person at a terminal, or a script.
#pragma once

#include <termios.h>

#include <optional>
#include <string>

#include "host/recorder/typed_line.hpp"

namespace fencepost::host {

/// Whether the terminal's keys are for this program, not for another job of the shell.
bool in_foreground();

class Keyboard {
 public:
  /// `edits`: a terminal without echo, because the status line shows what is typed; else bytes as they come.
  explicit Keyboard(bool edits);
  /// The terminal as it was.
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// The characters to send now; never waits. From a terminal whole lines, each ended with CR.
  std::string read();
  /// Once in a while: a shell that stopped and continued the program has set the terminal its own way.
  void tend();

  /// The terminal as it was, at once: for the handler of a signal that ends the program.
  static void give_back_terminal();

  /// The line being typed.
  [[nodiscard]] const std::string& typing() const { return line_.text(); }
  /// For WaitSet; -1 once it has ended.
  [[nodiscard]] int descriptor() const;

 private:
  void take_terminal();

  bool edits_;
  bool ended_ = false;
  std::optional<termios> before_;
  TypedLine line_;
};

}  // namespace fencepost::host
