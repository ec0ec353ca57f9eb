#include "drivers/odometry/tick_counter.hpp"

#include "hal/base/check.hpp"

namespace fencepost::odometry {
TickCounter::TickCounter(int bits, std::int64_t max_rate) : bits_(bits), max_rate_(max_rate) {
  FENCEPOST_CHECK(bits >= 2 && bits <= 32 && max_rate > 0);
}

std::int32_t TickCounter::difference(std::uint32_t raw) const {
  const int unused = 32 - bits_;
  // Shifted to the top, the difference wraps by itself; shifted back, it has its sign.
  return static_cast<std::int32_t>((raw - last_) << unused) >> unused;
}

std::optional<std::int32_t> TickCounter::step(std::uint32_t raw, base::Time t) {
  const std::int32_t counts = difference(raw);
  const base::Duration passed = t - last_t_;
  const bool was_known = known_;
  known_ = true;
  last_ = raw;
  last_t_ = t;
  constexpr base::Duration kLongest{std::int64_t{3'600} * base::Duration::kPerUnit};
  if (!was_known || passed.raw <= 0 || passed > kLongest) return std::nullopt;
  const std::int64_t possible = max_rate_ * (passed + kLateness).raw / base::Duration::kPerUnit + 1;
  const std::int64_t half_range = std::int64_t{1} << (bits_ - 1);
  if (possible >= half_range || counts > possible || counts < -possible) return std::nullopt;
  return counts;
}

}  // namespace fencepost::odometry
