// Whole lines on standard output, messages and the status line on standard error.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fencepost::host {

struct DisplaySettings {
  bool lines = true;             ///< show them at all
  bool out_is_terminal = false;  ///< then control characters are shown as question marks
  bool status = false;           ///< standard error is a terminal: it has a status line
};

/// Never blocks on the reader of standard output: what it does not accept in time is dropped from the display and
/// counted. A slow screen must not disturb the recording.
class Display {
 public:
  explicit Display(DisplaySettings settings) : settings_(settings) {}

  /// Bytes as they come; lines are shown once they are whole.
  void take(std::string_view bytes);
  /// Shows the remainder, including a line without end; waits for the reader at most `timeout_ms`.
  void finish(int timeout_ms);
  /// Once per loop iteration: writes what can be written now.
  void flush();
  /// For WaitSet, to be written; -1 while nothing waits.
  [[nodiscard]] int descriptor() const;

  /// A message line; like the status line it shows no control character, whoever's words it quotes.
  void say(std::string_view message);
  /// Replaces the status line; empty: none. Nothing happens where there is no status line.
  void set_status(const std::string& status);
  /// Characters that a status line may have.
  [[nodiscard]] static std::size_t status_width();

  [[nodiscard]] std::uint64_t lines_not_shown() const { return lines_not_shown_; }

  static constexpr std::size_t kMaxWaiting = 1 << 20;  ///< bytes: some seconds of any serial line

 private:
  void queue_line();
  void write_some();
  void stop_showing(int error);
  void erase_status();
  void draw_status();

  DisplaySettings settings_;
  std::string line_;     ///< the one that is not whole yet
  std::string waiting_;  ///< whole lines
  std::string status_;
  bool status_drawn_ = false;
  bool closed_ = false;
  std::uint64_t lines_not_shown_ = 0;
};

}  // namespace fencepost::host
