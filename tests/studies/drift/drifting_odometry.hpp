// Odometry that is off by a scale, by a turn and by random walks, and the truth beside it.
#pragma once

#include <string_view>
#include <vector>

#include "hal/sensor/odometry.hpp"
#include "host/result/result.hpp"
#include "host/simulate/random.hpp"

namespace fencepost::test {

/// Odometry as the reference drew it: a scale and a turn a metre. Each is one draw a run, and has a part that is drawn
/// step by step.
struct Drift {
  std::string_view key;
  double scale = 0;           ///< sigma, share of the distance
  double turn = 0;            ///< sigma, degrees a metre
  double turn_walk = 0;       ///< degrees a sqrt(m)
  double scale_walk = 0.003;  ///< share of the distance a sqrt(m): 1 % a step of 9 cm; none without a scale
};

/// The odometry of a robot of this drift, and where it truly was.
class DriftingOdometry {
 public:
  DriftingOdometry(unsigned seed, const Drift& drift);

  /// True samples in order of time; the first one is right.
  sensor::OdometrySample next(const sensor::OdometrySample& sample);

  /// So far, one for each sample.
  [[nodiscard]] const std::vector<host::PoseResult>& truth() const { return truth_; }

 private:
  void advance(const host::PoseResult& before, const host::PoseResult& now);

  host::Random random_;
  Drift drift_;
  double scale_;
  double turn_;
  host::PoseResult logged_;
  std::vector<host::PoseResult> truth_;
};

}  // namespace fencepost::test
