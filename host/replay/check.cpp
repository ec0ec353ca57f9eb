#include "host/replay/check.hpp"

#include <algorithm>

namespace fencepost::host {

void Check::settle(CheckOutcome& outcome) {
  constexpr std::size_t kShown = 20;
  for (const Logged& logged : logged_) {
    ++outcome.compared;
    const auto [first, last] = own_.equal_range(logged.key);
    if (std::any_of(first, last, [&](const auto& own) { return own.second == logged.line; })) continue;
    ++outcome.differing;
    if (outcome.mismatches.size() >= kShown) continue;
    const std::string ours = first == last ? "nothing of that kind, time and object" : first->second;
    outcome.mismatches.push_back("line " + std::to_string(logged.line_number) + ": logged " + logged.line +
                                 "\n  this replay: " + ours);
  }
  logged_.clear();
  own_.clear();
}

}  // namespace fencepost::host
