#include "host/replay/check.hpp"

#include <algorithm>
#include <optional>

namespace fencepost::host {
namespace {

constexpr std::array<record::Kind, 6> kCompared = {record::Kind::kObject,           record::Kind::kAlert,
                                                   record::Kind::kHeartbeat,        record::Kind::kSpeedLimit,
                                                   record::Kind::kCalibrationDoubt, record::Kind::kDigest};

/// "$FPALR,": the rest of it.
std::optional<record::Kind> kind_after_prefix(std::string_view start) {
  constexpr std::size_t kPrefix = record::kRecordStart.size();
  for (std::size_t i = 0; i < record::kKinds; ++i) {
    const auto kind = static_cast<record::Kind>(i);
    const std::string_view rest = record::name(kind).substr(kPrefix - 1);
    if (start.size() > kPrefix && start.substr(kPrefix).starts_with(rest) && start.ends_with(',')) return kind;
  }
  return std::nullopt;
}

/// "$FP", of which one character may be damaged.
bool nearly_begins(std::string_view start) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < record::kRecordStart.size(); ++i) {
    wrong += i < start.size() && start[i] == record::kRecordStart[i] ? 0U : 1U;
  }
  return wrong <= 1 && start.size() >= record::kRecordStart.size();
}

}  // namespace

void Check::unread(std::string_view start, const record::LineOutcome& line) {
  if (line.use == record::LineUse::kRecord || !nearly_begins(start)) return;
  const bool rejected = line.use == record::LineUse::kRejected;
  if (rejected && (line.reject == record::Reject::kTruncated || line.reject == record::Reject::kFormat)) return;
  const std::optional<record::Kind> kind = kind_after_prefix(start);
  const bool compared = kind && std::find(kCompared.begin(), kCompared.end(), *kind) != kCompared.end();
  // A damaged name may have been any; one that is whole and unknown is a newer version's.
  const bool any = !kind && rejected && line.reject != record::Reject::kKind;
  if (!compared && !any) return;
  if (outcome_.damaged++ == 0) outcome_.first_damaged = line.line_number;
}

bool Check::agrees(const Logged& logged) const {
  const auto [first, last] = own_.equal_range(logged.key);
  return std::any_of(first, last, [&](const auto& own) { return own.second == logged.line; });
}

void Check::take_logged(Logged logged) {
  ++outcome_.compared;
  if (agrees(logged)) return;
  waiting_.push_back(std::move(logged));
  if (waiting_.size() > kWindow) settle_first();
}

void Check::take_own(std::string key, std::string line) {
  ++told_;
  while (!waiting_.empty() && told_ - waiting_.front().told > kWindow / 2) settle_first();
  if (own_in_order_.size() == kWindow) {
    own_.erase(own_in_order_.front());
    own_in_order_.pop_front();
  }
  own_in_order_.push_back(own_.emplace(std::move(key), std::move(line)));
}

void Check::settle_first() {
  constexpr std::size_t kShown = 20;
  const Logged logged = std::move(waiting_.front());
  waiting_.pop_front();
  if (agrees(logged)) return;
  ++outcome_.differing;
  if (outcome_.mismatches.size() >= kShown) return;
  const auto first = own_.find(logged.key);
  const std::string ours = first == own_.end() ? "nothing of that kind, time and object" : first->second;
  outcome_.mismatches.push_back("line " + std::to_string(logged.line_number) + ": logged " + logged.line +
                                "\n  this replay: " + ours);
}

void Check::settle() {
  while (!waiting_.empty()) settle_first();
  own_.clear();
  own_in_order_.clear();
}

void Check::withdraw() {
  outcome_.compared = outcome_.differing = 0;
  outcome_.mismatches.clear();
}

}  // namespace fencepost::host
