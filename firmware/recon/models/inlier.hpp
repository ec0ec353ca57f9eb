// The inlier probability of a tangent, given its residual from the model.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/recon/models/tuning.hpp"
#include "hal/base/exp.hpp"

namespace fencepost::recon {

/// Most tangents are good: Lin = kInlierShare N(residual; 0, sigma). Of the others nothing is known but that they lie
/// within kOutlierReach, or kOutlierSigmas: Lout = (1 - kInlierShare) [farther_out if residual > 0] / max(reach,
/// sigmas). Returns Lin / (Lin + Lout). `residual`, `sigma` in m; `farther_out`: how likely an outlier farther out than
/// the model is against one inside it.
inline float inlier_share_by(float likely, float residual, float sigma, float farther_out) {
  constexpr float kSqrtTwoPi = 2.5066283F;
  constexpr float kInlier = kInlierShare / kSqrtTwoPi;
  constexpr float kOutlier = 0.1F;
  static_assert(kInlierShare + kOutlier == 1.0F);
  constexpr float kPerReach = 1.0F / kOutlierReach;
  constexpr float kPerSigmas = 1.0F / kOutlierSigmas;
  const float good = kInlier * likely;
  const float reach = sigma * kPerReach < kPerSigmas ? sigma * kPerReach : kPerSigmas;
  const float bad = kOutlier * (residual > 0 ? farther_out : 1.0F) * reach;
  return good / (good + bad);
}
/// `likely` is exp(-this).
inline float inlier_exponent(float residual, float sigma) {
  const float z = residual / sigma;
  return 0.5F * z * z;
}
inline float inlier_share(float residual, float sigma, float farther_out = kFartherOutliers) {
  return inlier_share_by(base::exp_minus(inlier_exponent(residual, sigma)), residual, sigma, farther_out);
}

/// The prior of a fit's spread.
struct SpreadPrior {
  float weight;    ///< in tangents
  float expected;  ///< mean of squared residuals, in squared sigmas
  float freedoms;  ///< degrees of freedom of the fit, in tangents
  float least;
  float most;
};

/// Running sums from which a fit learns how much larger residuals are than sigmas say.
struct Spread {
  float squares = 0;  ///< of residuals in sigmas, weighted
  float weight = 0;

  void add(float in_sigmas, float share) {
    squares += share * in_sigmas * in_sigmas;
    weight += share;
  }
  /// The square of that ratio.
  [[nodiscard]] float learnt(const SpreadPrior& prior) const {
    const float spread =
        (squares + prior.weight * prior.expected) / (std::max(1.0F, weight - prior.freedoms) + prior.weight);
    return std::clamp(spread, prior.least, prior.most);
  }
};

}  // namespace fencepost::recon
