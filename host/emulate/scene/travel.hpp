// The inverse of odometry: from poses to turns of the wheels.
#pragma once

#include <span>
#include <vector>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// Between two poses the robot drives an arc. With a turn of a over a chord of c it drives c (a/2) / sin(a/2) along the
/// middle heading. Distances and headings are sums from the first pose on, so rounding errors do not accumulate.
class TravelLog {
 public:
  /// Poses in order of time; headings wrapped or not. Without any, the robot is stationary.
  explicit TravelLog(std::span<const sensor::OdometrySample> poses);

  /// Interpolated; before the first pose and after the last the robot is stationary.
  [[nodiscard]] Travel at(base::Time t) const;

  /// Distance driven sideways, m, which no wheel can measure, without the share that rounding to 0.1 mm explains.
  [[nodiscard]] double sideways() const { return sideways_; }

 private:
  struct Knot {
    base::Time t;
    double distance = 0;
    double heading = 0;
  };
  std::vector<Knot> knots_;
  double sideways_ = 0;
};

}  // namespace fencepost::emulate
