// One line about long work, for whoever waits at a terminal: how much is done, how long the rest takes.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace fencepost::host::cli {

/// "8 s", "3 min 20 s", "1 h 5 min": to 10 s from a minute on, to a minute from ten.
std::string time_words(double seconds);

/// Where progress is shown if standard error is no terminal that can redraw (TERM is not "dumb").
enum class OffTerminal : unsigned char {
  kSilent,
  kLines,  ///< for work of minutes: a line after 10 s, then one a minute, for whoever reads a file or a pipe
};

/// Rewrites one line of standard error, where that is a terminal that can, and takes it away at its end. Nothing in the
/// first second, then ten times a second at most. Several threads may report to it. Lines of `say` go above it. One at
/// a time is shown: the latest.
class Progress {
 public:
  using Clock = std::function<std::chrono::duration<double>()>;
  using Write = std::function<void(std::string_view)>;

  explicit Progress(std::string what, OffTerminal elsewhere = OffTerminal::kSilent);
  /// For tests. Without `write` it is silent.
  Progress(std::string what, Clock clock, Write write, bool lines = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Work done, of all work, in any unit; `detail` is shown before it, such as "3 of 20 logs". The remaining time
  /// follows from the time taken so far.
  void at(double done, double all, std::string_view detail = {});
  /// The whole is not known: shows `detail` and the time it has taken.
  void at(std::string_view detail) { at(0, 0, detail); }

  /// Takes the line away until the next `at`, so that something else can be written.
  void hide();

 private:
  [[nodiscard]] std::string line(double done, double all, std::string_view detail, double seconds) const;

  std::string what_;
  Clock clock_;
  Write write_;
  bool lines_;
  std::mutex mutex_;
  std::chrono::duration<double> begin_;
  std::optional<std::chrono::duration<double>> shown_at_;
  std::string shown_;
};

/// Hides the line that is shown, if any; `say` does it.
void hide_progress();

}  // namespace fencepost::host::cli
