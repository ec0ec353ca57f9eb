// Brings the loop's journal to the log on disk: accepts, abandons, and reports it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "host/live/write_behind.hpp"

namespace fencepost::host {

/// The log is the whole truth up to its end. A disk that is too slow makes the loop refuse inputs, and count them. The
/// log ends, but not the run, when the disk fails or takes nothing for long while its memory is full.
class LogKeeper {
 public:
  using Say = std::function<void(std::string_view)>;

  /// nullptr: there is no log. `consequence` follows the reason why it ends, such as "; the run goes on without a log".
  LogKeeper(WriteBehind* log, Say say, std::string consequence, base::Time start)
      : log_(log), say_(std::move(say)), consequence_(std::move(consequence)), start_(start) {}

  /// Answers how many bytes of these whole lines are dealt with: all of them where there is no log any more.
  std::size_t take(std::string_view lines, base::Time now);
  /// The log has not taken all that it was offered last.
  [[nodiscard]] bool behind() const { return behind_; }
  /// Once all lines were taken: waits until they are on the disk, or it takes nothing for long.
  void close(base::Time now);

  [[nodiscard]] bool works() const { return log_ != nullptr && !failed_; }
  [[nodiscard]] bool failed() const { return failed_; }
  /// Bytes of records that are not in the log, all of them after `until`.
  [[nodiscard]] std::uint64_t lost() const;
  /// Since the start, if it failed.
  [[nodiscard]] base::Duration until() const { return until_; }

  /// A disk without progress for this long is reported.
  static constexpr base::Duration kSlow = base::milliseconds(2'000);
  /// After this long without progress the log is abandoned, at the end of a run or once its memory is full.
  static constexpr base::Duration kGivenUp = base::milliseconds(10'000);

 private:
  void watch_disk(base::Time now);
  void say_slow();
  void break_off(const std::string& reason, base::Time now);

  WriteBehind* log_;
  Say say_;
  std::string consequence_;
  base::Time start_;
  bool behind_ = false;
  bool said_slow_ = false;
  bool said_behind_ = false;
  bool failed_ = false;
  base::Duration until_;
  std::uint64_t discarded_ = 0;
};

}  // namespace fencepost::host
