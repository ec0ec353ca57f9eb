// How far a tangent is to be believed, given what the model says of it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hal/base/exp.hpp"

namespace fencepost::recon {

/// 9 of 10 tangents are good: Lin = 0.9 N(residual; 0, sigma). Of the others nothing is known but that they lie within
/// about 0.3 m, or 7.5 sigmas; farther out than the model they are a quarter as likely, for pieces get lost far more
/// often than segments grow: Lout = 0.1 [0.25 if residual > 0] / max(0.3 m, 7.5 sigma). Returns Lin / (Lin + Lout).
inline float inlier_share(float residual, float sigma) {
  constexpr float kInlier = 0.9F / 2.5066283F;
  constexpr float kOutlier = 0.1F;
  constexpr float kFartherOut = 0.25F;
  constexpr float kPerReach = 1.0F / 0.3F;
  constexpr float kPerSigmas = 1.0F / 7.52F;
  const float z = residual / sigma;
  const float good = kInlier * base::exp_minus(0.5F * z * z);
  const float reach = sigma * kPerReach < kPerSigmas ? sigma * kPerReach : kPerSigmas;
  const float bad = kOutlier * (residual > 0 ? kFartherOut : 1.0F) * reach;
  return good / (good + bad);
}

/// What a fit takes for granted of its spread before it has seen any tangent.
struct SpreadPrior {
  float weight;    ///< as if so many tangents had been seen
  float expected;  ///< and their squared residuals, in sigmas, had had this mean
  float freedoms;  ///< so many tangents a fit takes for itself
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

/// From so many tangents on a fit learns its spread.
inline constexpr std::uint8_t kTangentsForSpread = 7;

}  // namespace fencepost::recon
