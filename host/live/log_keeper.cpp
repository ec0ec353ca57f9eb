#include "host/live/log_keeper.hpp"

#include <fmt/format.h>

namespace fencepost::host {
namespace {

std::chrono::milliseconds real_time(base::Duration duration) {
  return std::chrono::milliseconds(duration.raw * 1'000 / base::Duration::kPerUnit);
}

std::string given_up(const WriteBehind& log) {
  return fmt::format(
      "the disk of the log {} has taken nothing for {:.0f} s; look at the end of 'dmesg', or choose another",
      log.name(), LogKeeper::kGivenUp.to_double());
}

}  // namespace

std::size_t LogKeeper::take(std::string_view lines, base::Time now) {
  if (log_ == nullptr) return lines.size();
  if (works()) {
    const std::size_t taken = log_->put(lines, now);
    behind_ = taken < lines.size();
    log_->tend(now);
    watch_disk(now);
    if (works()) return taken;
    lines.remove_prefix(taken);
    discarded_ += lines.size();
    return taken + lines.size();
  }
  discarded_ += lines.size();
  return lines.size();
}

void LogKeeper::watch_disk(base::Time now) {
  if (const auto fault = log_->fault()) return break_off(fault->sentence, now);
  const base::Duration stalled = log_->stalled(now);
  if (stalled >= kSlow) say_slow();
  if (!behind_) return;
  if (stalled >= kGivenUp) return break_off(given_up(*log_), now);
  if (said_behind_) return;
  said_behind_ = true;
  say_(fmt::format(
      "the disk of the log {} is too slow, and no memory is left for what waits: inputs wait or are refused, "
      "and counted, until it catches up",
      log_->name()));
}

void LogKeeper::say_slow() {
  if (said_slow_) return;
  said_slow_ = true;
  say_(fmt::format("the disk of the log {} has taken nothing for {:.0f} s; what is logged waits in memory",
                   log_->name(), kSlow.to_double()));
}

void LogKeeper::break_off(const std::string& reason, base::Time now) {
  failed_ = true;
  behind_ = false;
  until_ = now - start_;
  say_(reason + consequence_);
}

void LogKeeper::close(base::Time now) {
  if (!works()) return;
  if (!log_->close(real_time(kSlow))) {
    say_slow();
    if (!log_->close(real_time(kGivenUp))) return break_off(given_up(*log_), now);
  }
  if (const auto fault = log_->fault()) break_off(fault->sentence, now);
}

std::uint64_t LogKeeper::lost() const { return failed_ ? discarded_ + log_->lost() + log_->waiting() : 0; }

}  // namespace fencepost::host
