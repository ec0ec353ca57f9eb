// How evenly the times of one kind of record follow each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/base/units.hpp"
#include "host/geometry/median.hpp"

namespace fencepost::host::doctor {

struct Spacing {
  std::uint64_t count = 0;
  double rate = 0;         ///< a second, by the median interval; 0 with fewer than two
  std::uint64_t gaps = 0;  ///< intervals of more than kGapFactor times the median, and of more than kMinGap
  double longest = 0;      ///< s
  double longest_at = 0;   ///< s, where it begins
};

/// Numbers whose median or share is asked for: all up to kMax, of more evenly fewer, so that memory does not grow with
/// a log.
class Sample {
 public:
  static constexpr std::size_t kMax = 1U << 16U;

  void add(double value) {
    if (count_++ % step_ != 0) return;
    kept_.push_back(value);
    if (kept_.size() < kMax) return;
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
    kept_.resize((kept_.size() + 1) / 2);
    step_ *= 2;
  }
  /// In the order of `add`.
  [[nodiscard]] const std::vector<double>& kept() const { return kept_; }
  /// Samples that each kept one represents.
  [[nodiscard]] std::uint64_t step() const { return step_; }

 private:
  std::vector<double> kept_;
  std::uint64_t count_ = 0;
  std::uint64_t step_ = 1;
};

class SpacingMeter {
 public:
  static constexpr double kGapFactor = 4;
  static constexpr double kMinGap = 0.15;  ///< s: three frames of a camera of 20 a second

  void add(base::Time t);
  /// The clock begins again: no interval spans it.
  void restart() { last_.reset(); }
  [[nodiscard]] Spacing spacing() const;

 private:
  std::optional<base::Time> last_;
  std::uint64_t count_ = 0;
  Sample lengths_;
  Sample long_;  ///< of more than kMinGap
  double longest_ = 0;
  double longest_at_ = 0;
};

}  // namespace fencepost::host::doctor
