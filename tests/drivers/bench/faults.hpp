// The schedule of faults in a hostile hour: the same for every driver and in every run.
#pragma once

#include <cstdint>
#include <random>

#include "hal/base/units.hpp"

namespace fencepost::test {

/// Occasional faults: a stall, a reboot, an unplug; each ends after a while, followed by a pause of a few seconds.
class Faults {
 public:
  enum class Kind : std::uint8_t { kNone, kStall, kReboot, kUnplug };

  explicit Faults(std::uint32_t seed) : random_(seed) { next_ = base::Time{} + seconds(5, 15); }

  /// A fault that begins now, or kNone. It lasts until `over`.
  Kind begin(base::Time now) {
    if (now < next_) return Kind::kNone;
    over_ = now + base::milliseconds(static_cast<std::int64_t>(10 + random_() % 1'500));
    next_ = over_ + seconds(10, 30);
    ++count_;
    return static_cast<Kind>(1 + random_() % 3);
  }
  [[nodiscard]] bool over(base::Time now) const { return now >= over_; }
  /// Time since the last fault ended; negative in it.
  [[nodiscard]] base::Duration quiet(base::Time now) const { return now - over_; }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  base::Duration seconds(std::int64_t least, std::int64_t most) {
    const auto span = static_cast<std::uint64_t>((most - least) * 1'000);
    return base::milliseconds(least * 1'000 + static_cast<std::int64_t>(random_() % span));
  }

  std::mt19937 random_;
  base::Time next_;
  base::Time over_;
  std::uint32_t count_ = 0;
};

}  // namespace fencepost::test
