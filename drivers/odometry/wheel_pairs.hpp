// Counts of two wheels that are read one after the other.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/odometry/differential_drive.hpp"

namespace fencepost::odometry {

/// Left and right readings alternate, each with its own time. If they were treated as simultaneous, straight driving
/// would appear as an oscillating heading. So the left count at the time of the right one is interpolated between its
/// neighbours. The sample is emitted with the next left reading, at the right one's time. Of several right readings in
/// a row the last counts.
class WheelPairs {
 public:
  explicit WheelPairs(const WheelBase& wheels) : bits_(wheels.counter_bits), drive_(wheels) {}

  std::optional<sensor::OdometrySample> take_left(std::uint32_t count, base::Time t);
  void take_right(std::uint32_t count, base::Time t) { right_ = Reading{count, t}; }
  /// Both in one message.
  sensor::OdometrySample take_both(std::uint32_t left, std::uint32_t right, base::Time t);

  /// The device has restarted, or was silent: the pose stays.
  void forget();

 private:
  struct Reading {
    std::uint32_t count = 0;
    base::Time t;
  };
  [[nodiscard]] std::uint32_t left_at(base::Time t, const Reading& after) const;

  int bits_;
  DifferentialDrive drive_;
  std::optional<Reading> left_;
  std::optional<Reading> right_;
};

}  // namespace fencepost::odometry
