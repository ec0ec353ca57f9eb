#include "tests/studies/hazards/in_force.hpp"

#include <algorithm>
#include <limits>

namespace fencepost::test {

bool InForce::any(record::AlertLevel least) const {
  return std::any_of(levels_.begin(), levels_.end(), [&](const auto& entry) { return entry.second >= least; });
}

Stretches::Stretches(std::span<const record::AlertReport> alerts, record::AlertLevel least) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  InForce now;
  for (std::size_t i = 0; i < alerts.size(); ++i) {
    now.take(alerts[i]);
    // Alerts of one time count together.
    if (i + 1 < alerts.size() && alerts[i + 1].t == alerts[i].t) continue;
    const double t = alerts[i].t.to_double();
    const bool open = !stretches_.empty() && stretches_.back().to == kOpen;
    if (now.any(least) && !open) stretches_.push_back({t, kOpen});
    if (!now.any(least) && open) stretches_.back().to = t;
  }
}

bool Stretches::at(double t) const { return throughout(t, t); }

bool Stretches::throughout(double from, double to) const {
  return std::any_of(stretches_.begin(), stretches_.end(),
                     [&](const Stretch& stretch) { return stretch.from <= from && to < stretch.to; });
}

}  // namespace fencepost::test
