// How evenly the times of one kind of record follow each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/base/units.hpp"

namespace fencepost::host::doctor {

struct Spacing {
  std::uint64_t count = 0;
  double rate = 0;         ///< a second, by the median interval; 0 with fewer than two
  std::uint64_t gaps = 0;  ///< intervals of more than kGapFactor times the median, and of more than kLeastGap
  double longest = 0;      ///< s
  double longest_at = 0;   ///< s, where it begins
};

class SpacingMeter {
 public:
  static constexpr double kGapFactor = 4;
  static constexpr double kLeastGap = 0.15;  ///< s: three frames of a camera of 20 a second

  void add(base::Time t);
  /// The clock begins again: no interval spans it.
  void restart() { last_.reset(); }
  [[nodiscard]] Spacing spacing() const;

 private:
  struct Interval {
    double begin = 0;
    double length = 0;
  };
  std::optional<base::Time> last_;
  std::uint64_t count_ = 0;
  std::vector<Interval> intervals_;
};

/// 0 of nothing.
double median_of(std::vector<double> values);

}  // namespace fencepost::host::doctor
