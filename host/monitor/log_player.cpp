#include "host/monitor/log_player.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace fencepost::host::monitor {
namespace {

/// The first field of those kinds that begin with a time.
std::optional<double> time_of(std::string_view line) {
  constexpr std::array<std::string_view, 10> kTimed = {"$FPODO", "$FPFRM", "$FPOBJ", "$FPALR", "$FPALV",
                                                       "$FPSPD", "$FPLNK", "$FPSTA", "$FPPOS", "$FPCAL"};
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos || std::ranges::find(kTimed, line.substr(0, comma)) == kTimed.end()) return {};
  double t = 0;
  const char* const first = line.data() + comma + 1;
  const auto [end, error] = std::from_chars(first, line.data() + line.size(), t);
  return error == std::errc() && end != first ? std::optional(t) : std::nullopt;
}

}  // namespace

std::optional<std::string_view> LogPlayer::next(double t) {
  if (ended()) return std::nullopt;
  const std::size_t end = std::min(log_.find('\n', at_), log_.size() - 1) + 1;
  const std::string_view line(log_.data() + at_, end - at_);
  if (line.starts_with("$FPHDR") && at_ > 0) {
    run_began_ += last_;
    last_ = 0;
  }
  if (const auto when = time_of(line)) {
    if (run_began_ + *when > t) return std::nullopt;
    last_ = std::max(last_, *when);
  }
  at_ = end;
  return line;
}

void LogPlayer::rewind() {
  at_ = 0;
  run_began_ = last_ = 0;
}

}  // namespace fencepost::host::monitor
