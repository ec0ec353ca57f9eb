// This terminal as the console of `fencepost run`. Typed text stays whole while the robot talks, and urgent lines are
// coloured and ring the bell.
#pragma once

#include <functional>
#include <string>

#include "host/live/console_port.hpp"
#include "host/recorder/keyboard.hpp"

namespace fencepost::host {

/// Standard input and output, both terminals that can erase a line. The line being typed is below all others; Backspace
/// and Ctrl-U work, and with Enter it goes to the loop. `quit` and `exit` end the program as SIGTERM does.
class TypingConsole final : public ConsolePort {
 public:
  explicit TypingConsole(bool colour) : colour_(colour), keyboard_(true) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) override;
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override;
  void tend(base::Time now) override;
  [[nodiscard]] bool connected() const override { return error_ == 0; }
  [[nodiscard]] std::string problem() const override { return lost().value_or(std::string()); }
  [[nodiscard]] int descriptor() const override;
  [[nodiscard]] std::optional<std::string> lost() const override;
  std::uint64_t finish(std::chrono::milliseconds patience) override;
  void watch(linux::WaitSet& set, bool output_waits) const override;

  /// Calls `write`, which writes to this terminal, without the typed line.
  void without_typed_line(const std::function<void()>& write);

  static constexpr std::size_t kMaxWaiting = 8192;  ///< bytes; further output has to wait

 private:
  void take_line(std::string_view typed);
  [[nodiscard]] std::string shown(std::string line);
  void refresh(std::string_view lines);
  void flush();

  bool colour_;
  Keyboard keyboard_;
  base::Time now_;
  std::string commands_;  ///< typed, on their way to the loop
  std::string line_;      ///< of the robot, not whole yet
  std::string waiting_;   ///< on its way to the terminal
  std::string drawn_;     ///< the line being typed, as it is on the screen
  std::optional<base::Time> urgent_at_;
  int error_ = 0;  ///< of writing, for good
};

}  // namespace fencepost::host
