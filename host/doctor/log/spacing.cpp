#include "host/doctor/log/spacing.hpp"

#include <algorithm>

namespace fencepost::host::doctor {

void SpacingMeter::add(base::Time t) {
  ++count_;
  if (last_) {
    const double length = (t - *last_).to_double();
    lengths_.add(length);
    if (length > kMinGap) long_.add(length);
    if (length > longest_) {
      longest_ = length;
      longest_at_ = last_->to_double();
    }
  }
  last_ = t;
}

Spacing SpacingMeter::spacing() const {
  Spacing spacing;
  spacing.count = count_;
  const double median = median_of(lengths_.kept());
  if (median > 0) spacing.rate = 1 / median;
  const double least = std::max(kMinGap, kGapFactor * median);
  const auto gaps = std::ranges::count_if(long_.kept(), [&](double length) { return length > least; });
  spacing.gaps = static_cast<std::uint64_t>(gaps) * long_.step();
  spacing.longest = longest_;
  spacing.longest_at = longest_at_;
  return spacing;
}

}  // namespace fencepost::host::doctor
