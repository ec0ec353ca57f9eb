#include "firmware/alert/camera_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/alert/tuning.hpp"

namespace fencepost::alert {

using record::Doubt;

namespace {

// Depth by the rows over the true depth: the inverse mean of `wrong` objects' scales.
float factor_of(unsigned wrong, float scales) { return scales > 0 ? static_cast<float>(wrong) / scales : 1.0F; }

}  // namespace

void RowVotes::add(const recon::ObjectCore& object) {
  if (!object.used() || !object.confirmed) return;
  // The foot of a wall longer than the image is another point of it in each frame.
  if (!object.cylinder.known_whole()) return;
  const recon::RowTrend& trend = object.cylinder.row_trend();
  switch (trend.verdict()) {
    case recon::RowVerdict::kUnknown: break;
    case recon::RowVerdict::kTrue: ++right; break;
    case recon::RowVerdict::kTooFar:
      ++too_far;
      scales_too_far += trend.scale();
      break;
    case recon::RowVerdict::kTooNear:
      ++too_near;
      scales_too_near += trend.scale();
      break;
  }
}

bool CameraDoubt::judge(const RowVotes& votes, std::optional<float> lens, base::Time t) {
  if (lens) return say(Doubt::kLens, *lens, t);
  const bool far = votes.too_far >= votes.too_near;
  const unsigned wrong = far ? votes.too_far : votes.too_near;
  const unsigned against = votes.right + (far ? votes.too_near : votes.too_far);
  if (wrong >= kDoubtfulObjects && wrong > against) {
    const float factor = factor_of(wrong, far ? votes.scales_too_far : votes.scales_too_near);
    if (factor >= kMinNearer || factor * kMinFarther <= 1) return say(Doubt::kRows, factor, t);
  }
  const bool holds = said_.doubt == Doubt::kRows && wrong >= votes.right;
  return !holds && say(Doubt::kNone, 1, t);
}

bool CameraDoubt::forget(base::Time t) { return say(Doubt::kNone, 1, t); }

float CameraDoubt::caution() const { return any() ? std::clamp(said_.factor.to_float(), 1.0F, kMaxCaution) : 1.0F; }

bool CameraDoubt::say(Doubt doubt, float factor, base::Time t) {
  constexpr float kMin = 0.01F;
  constexpr float kMax = 100;
  constexpr auto kUnit = static_cast<float>(base::Ratio2::kPerUnit);
  const base::Ratio2 rounded{static_cast<std::int32_t>(kUnit * std::clamp(factor, kMin, kMax) + 0.5F)};
  const std::int32_t change = rounded.raw - said_.factor.raw;
  if (doubt == said_.doubt && change < kDoubtStep && change > -kDoubtStep) return false;
  said_ = {t, doubt, rounded};
  return true;
}

}  // namespace fencepost::alert
