// Decides whether odometry drifts, or whether the camera or the objects differ from their configuration. A wrong pitch
// or a foot above the floor makes rows wrong. A shape that is not round makes widths wrong. The filter then moves the
// robot to make them fit. Bearings gain nothing by that: they fit the objects where odometry has placed them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/localize/landmark_filter.hpp"
#include "firmware/recon/localize/tuning.hpp"

namespace fencepost::recon {

/// Sums how much better bearings fit the filter's pose and landmarks than odometry and the map's objects.
template <std::size_t kLandmarks>
class DriftEvidence {
 public:
  void clear() {
    sum_ = 0;
    each_.fill(0);
  }
  /// The landmark in `slot` is another one from now on.
  void forget(std::size_t slot) { each_[slot] = 0; }
  /// A bearing of the landmark in `slot` (`variance` of its bound, m^2), before anybody has learnt from it. From the
  /// robot to the object, robot axes, m, as the odometry and as the filter has it.
  void weigh(std::size_t slot, const CircleEquation& bearing, float variance, const Vec2& by_odometry,
             const Vec2& by_filter) {
    const auto off = [&](const Vec2& away) {
      const float residual = bearing.bound - bearing.normal.dot(away);
      return std::min(kMaxEvidence, residual * residual / variance);
    };
    const float better = off(by_odometry) - off(by_filter) - kEvidenceSlack;
    sum_ = std::max(0.0F, sum_ + better);
    each_[slot] = std::max(0.0F, each_[slot] + better);
  }
  /// Drift shows in every landmark, a mix-up of two alike in one: the others have to say enough without it.
  [[nodiscard]] bool enough(float least) const {
    const float all = std::accumulate(each_.begin(), each_.end(), 0.0F);
    return sum_ > least && all - *std::max_element(each_.begin(), each_.end()) > least;
  }
  /// For the digest.
  [[nodiscard]] float sum() const { return sum_; }

 private:
  // Differences of squared sigmas, which begin again where odometry was right all the time.
  float sum_ = 0;
  std::array<float, kLandmarks> each_{};
};

}  // namespace fencepost::recon
