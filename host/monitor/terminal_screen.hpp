// Takes the terminal for a screen, and gives it back as it was, however the program ends.
#pragma once

#include <string>
#include <vector>

#include "host/monitor/cells.hpp"

namespace fencepost::host::monitor {

/// The alternate screen of standard output, without cursor; keys come from standard input, where that is a terminal, at
/// once and without echo. One object at a time. Also given back by the handler of a fault (SIGSEGV and the like).
class TerminalScreen {
 public:
  explicit TerminalScreen(bool colour);
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;

  /// As it is now.
  [[nodiscard]] static Size size();
  /// Sends the rows that changed. False: the terminal has gone.
  bool show(const Cells& cells, bool bell);
  /// Typed characters; never waits. Escape sequences of cursor keys are left out.
  std::string keys();
  [[nodiscard]] bool has_keys() const { return has_keys_; }

  /// At once: for the handler of a signal that ends the program.
  static void give_back();

 private:
  bool colour_;
  bool has_keys_;
  Size shown_size_{0, 0};
  std::vector<std::string> shown_;
};

}  // namespace fencepost::host::monitor
