// How much of their power a board's own motors get, so that the robot is no faster than it may be. Which power makes
// which speed differs from robot to robot and with its battery: odometry shows it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/base/stamp.hpp"
#include "hal/base/units.hpp"

namespace fencepost::loop {

class Throttle {
 public:
  /// Several times in 20 ms. `wanted`: % of the power, 0: they stand. `most`: mm/s that the robot may have. `speed`:
  /// m/s by odometry. The % to give, which is `wanted` when they begin.
  [[nodiscard]] std::int32_t judge(std::int32_t wanted, std::int16_t most, float speed, base::Time now) {
    const std::int32_t full = wanted * kParts;
    if (wanted == 0 || power_ == 0) {
      power_ = full;
      adjusted_ = base::Stamp(now);
    } else if (adjusted_.since(now) >= kInterval) {
      adjusted_ = base::Stamp(now);
      adjust(most, std::fabs(speed));
    }
    power_ = std::min(power_, full);
    return power_ / kParts;
  }

 private:
  static constexpr std::int32_t kParts = 16;  ///< of a percent
  /// Odometry shows a change after about as long. More: late; less: power that swings. By design.
  static constexpr base::Duration kInterval = base::milliseconds(100);
  /// Of the power that is taken off where the robot is too fast: the speed limit of one that obeys falls by a twelfth
  /// meanwhile. By design.
  static constexpr std::int32_t kLess = 8;
  /// Likewise, added where it is slower than it may be. More: motors that need some power to move at all swing. By
  /// design.
  static constexpr std::int32_t kMore = 32;
  /// Share of what it may have that is fast enough. By design.
  static constexpr float kEnough = 0.75F;

  void adjust(std::int16_t most, float speed) {
    const float share = 1000 * speed / static_cast<float>(std::max(most, std::int16_t{1}));
    if (share > 1) power_ -= power_ / kLess;
    if (share < kEnough) power_ += power_ / kMore + 1;
  }

  std::int32_t power_ = 0;  ///< parts of a percent; 0: they stand
  base::Stamp adjusted_;
};

}  // namespace fencepost::loop
