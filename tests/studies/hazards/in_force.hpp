// Which alerts are in force: the last word about each id.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "firmware/record/records.hpp"

namespace fencepost::test {

/// A robot that has to stop does not ask who says so.
class InForce {
 public:
  void take(const record::AlertReport& alert) { levels_[alert.id] = alert.level; }
  /// Any alert of that level or a higher one.
  [[nodiscard]] bool any(record::AlertLevel least) const;

 private:
  std::map<std::uint32_t, record::AlertLevel> levels_;
};

struct Stretch {
  double from = 0;
  double to = 0;
};

/// The times when an alert of `least` or higher was in force, in order, s. A stretch lasts from the first of a row of
/// alerts to the end of the last.
class Stretches {
 public:
  /// `alerts` in order of time; an alert in force at the end stays so.
  Stretches(std::span<const record::AlertReport> alerts, record::AlertLevel least);

  [[nodiscard]] const std::vector<Stretch>& all() const { return stretches_; }
  [[nodiscard]] bool at(double t) const;
  /// All the time from `from` to `to`.
  [[nodiscard]] bool throughout(double from, double to) const;

 private:
  std::vector<Stretch> stretches_;
};

}  // namespace fencepost::test
