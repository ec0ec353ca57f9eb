#include "drivers/odometry/wheel_pairs.hpp"

namespace fencepost::odometry {
namespace {

// Two readings of one wheel further apart than this are not interpolated.
constexpr base::Duration kLongestPair = base::milliseconds(500);

}  // namespace

std::optional<sensor::OdometrySample> WheelPairs::take_left(std::uint32_t count, base::Time t) {
  const Reading reading{count, t};
  std::optional<sensor::OdometrySample> sample;
  if (left_ && right_ && right_->t >= left_->t && t - left_->t <= kLongestPair) {
    sample = drive_.take(left_at(right_->t, reading), right_->count, right_->t);
  }
  left_ = reading;
  right_.reset();
  return sample;
}

sensor::OdometrySample WheelPairs::take_both(std::uint32_t left, std::uint32_t right, base::Time t) {
  return drive_.take(left, right, t);
}

std::uint32_t WheelPairs::left_at(base::Time t, const Reading& after) const {
  const int unused = 32 - bits_;
  // Counts wrap; their difference, shifted to the top and back, does not.
  const std::int32_t counts = static_cast<std::int32_t>((after.count - left_->count) << unused) >> unused;
  const std::int64_t span = (after.t - left_->t).raw;
  if (span <= 0) return after.count;
  return left_->count + static_cast<std::uint32_t>(divide_nearest(counts * (t - left_->t).raw, span));
}

void WheelPairs::forget() {
  left_.reset();
  right_.reset();
  drive_.forget_counts();
}

}  // namespace fencepost::odometry
