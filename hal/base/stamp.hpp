// When something last happened, in four bytes: the low word of the clock.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"

namespace fencepost::base {

class Stamp {
 public:
  constexpr Stamp() = default;
  constexpr explicit Stamp(Time t) : ticks_(low_word(t)) {}

  /// Time from the stamp to `now`. Right for the 4.9 days before `now` and for kBackwards after it. A longer time comes
  /// out shorter by whole rounds of the word, which delays a repetition once.
  [[nodiscard]] constexpr Duration since(Time now) const {
    const std::uint32_t ahead = low_word(now) - ticks_;
    constexpr auto kBack = static_cast<std::uint32_t>(kBackwards.raw);
    if (ahead > UINT32_MAX - kBack) return {-static_cast<std::int64_t>(UINT32_MAX - ahead) - 1};
    return {static_cast<std::int64_t>(ahead)};
  }

 private:
  /// Frames are handled up to their latency and waiting time after later odometry.
  static constexpr Duration kBackwards = milliseconds(60'000);

  static constexpr std::uint32_t low_word(Time t) { return static_cast<std::uint32_t>(t.raw & 0xFFFFFFFFLL); }

  std::uint32_t ticks_ = 0;
};

}  // namespace fencepost::base
