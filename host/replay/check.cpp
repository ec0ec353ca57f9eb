#include "host/replay/check.hpp"

#include <algorithm>

namespace fencepost::host {

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

}  // namespace fencepost::host
