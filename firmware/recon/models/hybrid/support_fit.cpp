#include "firmware/recon/models/hybrid/support_fit.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hybrid/low_order_fit.hpp"
#include "firmware/recon/models/hybrid/phase_tables.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {
namespace {

static_assert(kRing == kDirections);

std::size_t next(std::size_t k) { return (k + 1) % kRing; }
std::size_t previous(std::size_t k) { return (k + kRing - 1) % kRing; }

}  // namespace

void SupportFit::begin(float spread) {
  spread_ = spread;
  measure();
}

void SupportFit::begin_pass(float widening) {
  band_.clear();
  for (float& entry : band_.diagonal) entry = 1.0F / (kHold * kHold);
  scale_ = widening * std::sqrt(spread_);
  sums_ = {};
  tangents_ = 0;
}

void SupportFit::add(ConstClusters clusters, std::size_t index) {
  const Cluster cluster = unpack(clusters[index]);
  const std::size_t k = index / kClustersPerSector;
  const auto [a, b] = kEndShares[place_in_sector(clusters[index])];
  const float residual = cluster.offset - a * offsets_[k] - b * offsets_[next(k)];
  if (cluster.lower_bound && residual <= 0) return;
  const float sigma = cluster.sigma * scale_;
  const float believed = cluster.views * standing(clusters, index) * inlier_share(residual, sigma);
  if (!cluster.lower_bound) {
    sums_.add(residual / cluster.sigma, believed);
    ++tangents_;
  }
  const float weight = believed / (sigma * sigma);
  band_.diagonal[k] += weight * a * a;
  band_.first[k] += weight * a * b;
  band_.diagonal[next(k)] += weight * b * b;
  band_.rhs[k] += weight * a * residual;
  band_.rhs[next(k)] += weight * b * residual;
}

void SupportFit::begin_sides() {
  const NodeStep step = node_step(kRing);
  const float share = std::clamp(kSharePerTangent * static_cast<float>(tangents_), kMinSideShare, 1.0F);
  const float sigma = kSideSigma * share * radius_;
  round_side_ = step.angle * radius_;
  side_weight_ = 1.0F / (sigma * sigma * step.angle);
}

void SupportFit::add_side(std::size_t k, bool polygonal) {
  const NodeStep step = node_step(kRing);
  const std::size_t before = previous(k);
  const std::size_t after = next(k);
  const float outer = 1.0F / step.sine;
  const float middle = -2.0F * step.cosine / step.sine;
  const float length = outer * (offsets_[before] + offsets_[after]) + middle * offsets_[k];
  float weight = side_weight_;
  float target = round_side_;
  if (polygonal) {
    weight *= round_side_ / (std::max(length, 0.0F) + kSoftening * round_side_);
    target = length > kLongSide * round_side_ ? round_side_ : 0.0F;
  }
  if (length < 0) {
    weight *= kStiffness;
    target = 0;
  }
  const float pull = weight * (target - length);
  band_.diagonal[before] += weight * outer * outer;
  band_.diagonal[k] += weight * middle * middle;
  band_.diagonal[after] += weight * outer * outer;
  band_.first[before] += weight * outer * middle;
  band_.first[k] += weight * middle * outer;
  band_.second[before] += weight * outer * outer;
  band_.rhs[before] += pull * outer;
  band_.rhs[k] += pull * middle;
  band_.rhs[after] += pull * outer;
}

void SupportFit::finish_pass(bool learn_spread) {
  for (std::size_t k = 0; k < kRing; ++k) offsets_[k] += band_.rhs[k];
  measure();
  if (!learn_spread || tangents_ < kTangentsForSpread) return;
  spread_ = sums_.learnt(kSupportSpread);
}

void SupportFit::measure() {
  float sum = 0;
  for (const float offset : offsets_) sum += offset;
  radius_ = std::clamp(sum / static_cast<float>(kRing), kMinRadius, kLargestPrior);
}

Vec2 SupportFit::center() const {
  Vec2 sum{0, 0};
  for (std::size_t k = 0; k < kRing; ++k) sum += offsets_[k] * node_direction(k, kRing);
  return sum * (2.0F / static_cast<float>(kRing));
}

}  // namespace fencepost::recon
