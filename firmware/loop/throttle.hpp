// Controls the power of a board's own motors so that the robot keeps its maximum speed. The speed for a given power
// differs from robot to robot and with the battery, so odometry closes the loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/base/stamp.hpp"
#include "hal/base/units.hpp"

namespace fencepost::loop {

class Throttle {
 public:
  /// To be called several times in 20 ms. `wanted`: % of the power, 0: stop. `most`: the robot's maximum speed, mm/s.
  /// `speed`: m/s by odometry. Returns the % to give, which is `wanted` at the start.
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
  /// Time between two changes, about that until odometry shows one. More: late; less: power that swings. By design.
  static constexpr base::Duration kInterval = base::milliseconds(100);
  /// The power is reduced by one part in kLess where the robot is too fast. Meanwhile the speed limit of a robot that
  /// obeys falls by a twelfth. By design.
  static constexpr std::int32_t kLess = 8;
  /// Likewise, one part in kMore is added where the robot is slower than it may be. More power added: motors that need
  /// some power to move at all swing. By design.
  static constexpr std::int32_t kMore = 32;
  /// Share of the maximum speed that is fast enough. By design.
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
