#include "firmware/recon/models/row_trend.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hash.hpp"
#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {

void RowTrend::add(const Vec2& lens, const Vec2& bearing, float range, float weight) {
  if (weight_ > 0) travelled_ += bearing.dot(lens - lens_);
  // From another side the foot is another point of the object.
  if (!(weight_ > 0) || std::fabs(cross(first_bearing_, bearing)) > kSameSide) {
    weight_ = travel_ = travel_square_ = range_ = travel_range_ = travelled_ = 0;
    first_bearing_ = bearing;
  }
  lens_ = lens;
  bearing_ = bearing;
  const float weighted = weight * travelled_;
  weight_ += weight;
  travel_ += weighted;
  travel_square_ += weighted * travelled_;
  range_ += weight * range;
  travel_range_ += weighted * range;
}

void RowTrend::judge() {
  verdict_ = RowVerdict::kUnknown;
  scale_ = 1;
  if (!(weight_ > 0)) return;
  const float spread = this->spread();
  if (!(spread > 0)) return;
  const float fall = (travel_ * range_ / weight_ - travel_range_) / spread;
  // The sum of three variances: noise, a foot that wanders on the object, and the error of the robot's way.
  const float sigma = std::sqrt((1 + kFootWanders * kFootWanders * weight_) / spread + kTravelError * kTravelError);
  const float off = fall - 1;
  if (std::fabs(off) <= std::max(kKnownSigmas * sigma, kMinTrend)) {
    if (sigma < kTrendSigma) verdict_ = RowVerdict::kTrue;
    return;
  }
  verdict_ = off > 0 ? RowVerdict::kTooFar : RowVerdict::kTooNear;
  scale_ = std::clamp(1 / std::max(fall, kMinTrueShare), kMinTrueShare, 1 / kMinTrueShare);
}

RowTrend::Front RowTrend::front() const {
  const float mean_travel = travel_ / weight_;
  const float ahead = range_ / weight_ * scale_;  // of where the robot was on the mean
  const float away = mean_travel + ahead - travelled_;
  // The variance of the mean, and that of the slope over the extrapolated length.
  const float variance = scale_ * scale_ * (1 / weight_ + ahead * ahead / spread());
  return {{-bearing_, -(bearing_.dot(lens_) + away)}, variance};
}

void RowTrend::hash(base::Fnv1a64& hash) const {
  for (const float value : {weight_, travel_, travel_square_, range_, travel_range_, travelled_}) hash.f32(value);
  hash_vec(hash, lens_);
  hash_vec(hash, bearing_);
  hash_vec(hash, first_bearing_);
  hash.u8(static_cast<std::uint8_t>(verdict_));
  if (verdict_ != RowVerdict::kUnknown) hash.f32(scale_);
}

}  // namespace fencepost::recon
