// Does odometry drift, or is the camera, or what stands there, not as was told? A row can lie, because of a wrong pitch
// or a foot that hangs above the floor, and so can a width, of what is not round; then the filter moves the robot to
// make them fit. That helps no bearing: where objects are that odometry has placed, they fit the odometry.
#pragma once

#include <algorithm>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/localize/landmark_filter.hpp"
#include "firmware/recon/localize/tuning.hpp"

namespace fencepost::recon {

/// By how much bearings fit the poses of the filter and its landmarks better than the odometry and the map's objects.
class DriftEvidence {
 public:
  void clear() { sum_ = 0; }
  /// A bearing (`variance` of its bound, m^2), before anybody has learnt from it. From the robot to the object, robot
  /// axes, m, as the odometry and as the filter has it.
  void weigh(const CircleEquation& bearing, float variance, const Vec2& by_odometry, const Vec2& by_filter) {
    const auto off = [&](const Vec2& away) {
      const float residual = bearing.bound - bearing.normal.dot(away);
      return std::min(kMostEvidence, residual * residual / variance);
    };
    sum_ = std::max(0.0F, sum_ + off(by_odometry) - off(by_filter) - kEvidenceSlack);
  }
  [[nodiscard]] bool enough(float least) const { return sum_ > least; }
  /// For the digest.
  [[nodiscard]] float sum() const { return sum_; }

 private:
  float sum_ = 0;  ///< of differences of squared sigmas; begins again where odometry was right all the time
};

}  // namespace fencepost::recon
