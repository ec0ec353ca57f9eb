#include "firmware/recon/models/hybrid/low_order_fit.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hybrid/triangle.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"
#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {
void series_basis(const Vec2& direction, std::span<float> basis) {
  basis[0] = 1;
  Vec2 multiple = direction;
  for (std::size_t m = 1; 2 * m < basis.size(); ++m) {
    basis[2 * m - 1] = multiple.x();
    basis[2 * m] = multiple.y();
    multiple = rotated(multiple, direction);
  }
}

bool factorise_row(std::span<float> matrix, std::size_t i) { return factorise_triangle_row<float>(matrix, i); }
void solve_lower(std::span<const float> factor, std::span<float> b) { solve_lower_triangle<float, float>(factor, b); }
void solve_upper(std::span<const float> factor, std::span<float> b) { solve_upper_triangle<float, float>(factor, b); }

void add_series_priors(const RadiusPrior& prior, std::size_t order, std::span<const float> x, std::span<float> matrix,
                       std::span<float> rhs) {
  const auto add_prior = [&](std::size_t i, float mean, float sigma) {
    const float weight = 1.0F / (sigma * sigma);
    matrix[row_of(i) + i] += weight;
    rhs[i] += weight * (mean - x[i]);
  };
  add_prior(0, prior.mean, prior.sigma);
  add_prior(1, 0, kCenterSigma);
  add_prior(2, 0, kCenterSigma);
  const float radius = std::clamp(x[0], kMinRadius, kLargestPrior);
  for (std::size_t m = 2; m <= order; ++m) {
    const float sigma = kShapeShare * radius / static_cast<float>(m * m - 1);
    add_prior(2 * m - 1, 0, sigma);
    add_prior(2 * m, 0, sigma);
  }
}

template <std::size_t kOrder>
void LowOrderFit<kOrder>::begin(const RadiusPrior& radius) {
  radius_ = radius;
  x_.fill(0);
  x_[0] = radius.mean;
  spread_ = kFirstSpread;
}

template <std::size_t kOrder>
void LowOrderFit<kOrder>::add_support_value(const Vec2& direction, float offset, float share) {
  std::array<float, kUnknowns> basis{};
  series_basis(direction, basis);
  x_[0] += share * offset;
  for (std::size_t i = 1; i < kUnknowns; ++i) x_[i] += 2.0F * share * offset * basis[i];
}

template <std::size_t kOrder>
void LowOrderFit<kOrder>::begin_pass(float widening) {
  matrix_.fill(0);
  rhs_.fill(0);
  scale_ = widening * std::sqrt(spread_);
  sums_ = {};
  tangents_ = 0;
}

template <std::size_t kOrder>
void LowOrderFit<kOrder>::add(ConstClusters clusters, std::size_t index, bool trusted) {
  const Cluster cluster = unpack(clusters[index]);
  std::array<float, kUnknowns> basis{};
  series_basis(direction_of(clusters, index), basis);
  float residual = cluster.offset - x_[0];
  for (std::size_t i = 1; i < kUnknowns; ++i) residual -= basis[i] * x_[i];
  if (cluster.lower_bound && (trusted || residual <= 0)) return;
  const float sigma = cluster.sigma * scale_;
  const float share = trusted ? 1.0F : inlier_share(residual, sigma);
  const float believed = cluster.views * standing(clusters, index) * share;
  if (!cluster.lower_bound) {
    sums_.add(residual / cluster.sigma, believed);
    ++tangents_;
  }
  const float weight = believed / (sigma * sigma);
  // The first function is 1.
  float* entry = matrix_.data();
  *entry++ += weight;
  rhs_[0] += weight * residual;
  for (std::size_t i = 1; i < kUnknowns; ++i) {
    const float weighted = weight * basis[i];
    rhs_[i] += weighted * residual;
    *entry++ += weighted;
    for (std::size_t j = 1; j <= i; ++j) *entry++ += weighted * basis[j];
  }
}

template <std::size_t kOrder>
void LowOrderFit<kOrder>::finish_pass(bool learn_spread) {
  solve_lower(matrix_, rhs_);
  solve_upper(matrix_, rhs_);
  for (std::size_t i = 0; i < kUnknowns; ++i) x_[i] += rhs_[i];
  if (learn_spread && tangents_ >= kTangentsForSpread) spread_ = sums_.learnt(kLowOrderSpread);
}

template <std::size_t kOrder>
SeriesValue LowOrderFit<kOrder>::at(const Vec2& direction) const {
  std::array<float, kUnknowns> basis{};
  series_basis(direction, basis);
  float offset = x_[0];
  for (std::size_t i = 1; i < kUnknowns; ++i) offset += basis[i] * x_[i];
  solve_lower(matrix_, basis);  // b' (L L')^-1 b = |L^-1 b|^2
  float variance = 0;
  for (const float entry : basis) variance += entry * entry;
  return {offset, std::sqrt(variance)};
}

template class LowOrderFit<3>;
template class LowOrderFit<5>;

}  // namespace fencepost::recon
