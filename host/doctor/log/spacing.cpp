#include "host/doctor/log/spacing.hpp"

#include <algorithm>

namespace fencepost::host::doctor {

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void SpacingMeter::add(base::Time t) {
  ++count_;
  if (last_) intervals_.push_back({last_->to_double(), (t - *last_).to_double()});
  last_ = t;
}

Spacing SpacingMeter::spacing() const {
  Spacing spacing;
  spacing.count = count_;
  std::vector<double> lengths;
  for (const Interval& interval : intervals_) lengths.push_back(interval.length);
  const double median = median_of(std::move(lengths));
  if (median > 0) spacing.rate = 1 / median;
  const double least = std::max(kLeastGap, kGapFactor * median);
  for (const Interval& interval : intervals_) {
    if (interval.length > least) ++spacing.gaps;
    if (interval.length <= spacing.longest) continue;
    spacing.longest = interval.length;
    spacing.longest_at = interval.begin;
  }
  return spacing;
}

}  // namespace fencepost::host::doctor
