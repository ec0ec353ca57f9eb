// Plays a run's log line by line at the times of its records.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fencepost::host::monitor {

class LogPlayer {
 public:
  explicit LogPlayer(std::string log) : log_(std::move(log)) {}

  /// The next line with its end, if its time has come; nothing: later, or it has ended. `t`: s since the beginning,
  /// over all runs of the log.
  std::optional<std::string_view> next(double t);
  [[nodiscard]] bool ended() const { return at_ == log_.size(); }
  void rewind();

 private:
  std::string log_;
  std::size_t at_ = 0;
  double run_began_ = 0;  ///< s, of all runs before this one
  double last_ = 0;       ///< s, of the last record with a time
};

}  // namespace fencepost::host::monitor
