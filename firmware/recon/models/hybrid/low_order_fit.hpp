// The outline as a short Fourier series: h(phi) = r + c.n + sum over m of a_m cos(m phi) + b_m sin(m phi). Order 1 is
// the cylinder. Robust least squares, a little at a time, with weak priors, so that one view is enough.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/models/hybrid/sector_store.hpp"
#include "firmware/recon/models/inlier.hpp"
#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {

inline constexpr std::size_t kHighestOrder = 5;
constexpr std::size_t series_size(std::size_t order) { return 1 + 2 * order; }
constexpr std::size_t packed_size(std::size_t unknowns) { return unknowns * (unknowns + 1) / 2; }

/// The series' functions at a direction: 1, cos, sin, cos 2, sin 2, ... `basis` has series_size(order) entries.
void series_basis(const Vec2& direction, std::span<float> basis);

/// Lower triangle by rows: (0,0) (1,0) (1,1) ... Row i is replaced by that of its Cholesky factor; those before it have
/// been. False if a pivot is lost to rounding.
bool factorise_row(std::span<float> matrix, std::size_t i);
/// L x = b, in place.
void solve_lower(std::span<const float> factor, std::span<float> b);
/// L' x = b, in place.
void solve_upper(std::span<const float> factor, std::span<float> b);

/// Adds the priors of a series with the current coefficients `x` to the packed matrix and the right side.
void add_series_priors(const RadiusPrior& prior, std::size_t order, std::span<const float> x, std::span<float> matrix,
                       std::span<float> rhs);

inline constexpr SpreadPrior kLowOrderSpread{
    .weight = 4.0F, .expected = 3.0F, .freedoms = 4.0F, .least = 0.05F, .most = 9.0F};

/// h at a direction, and its standard deviation as the last pass knows it.
struct SeriesValue {
  float offset = 0;
  float sigma = 0;
};

/// One fit. Unknowns are solved for as corrections of what is there, so that float rounding does not add up.
template <std::size_t kOrder>
class LowOrderFit {
  static_assert(kOrder >= 1 && kOrder <= kHighestOrder);

 public:
  static constexpr std::size_t kUnknowns = series_size(kOrder);

  void begin(const RadiusPrior& radius);
  /// After begin(): the series nearest to an outline, of which each support value is added once. `share`: 1 / their
  /// number.
  void clear_series() { x_.fill(0); }
  void add_support_value(const Vec2& direction, float offset, float share);
  /// Starts one weighing of all tangents; sigmas count `widening` times.
  void begin_pass(float widening);
  /// Adds cluster `index`. `trusted`: no tangent is doubted. What says `at least` counts where it is not met, and not
  /// as long as nothing is doubted.
  void add(ConstClusters clusters, std::size_t index, bool trusted);
  /// All tangents are in: the priors.
  void begin_solution() { add_series_priors(radius_, kOrder, x_, matrix_, rhs_); }
  /// Row i = 0 .. kUnknowns - 1, in this order. False: ill-conditioned; nothing changes.
  [[nodiscard]] bool factorise(std::size_t i) { return factorise_row(matrix_, i); }
  /// Solves the pass, after the last row.
  void finish_pass(bool learn_spread);

  [[nodiscard]] SeriesValue at(const Vec2& direction) const;
  [[nodiscard]] Vec2 center() const { return {x_[1], x_[2]}; }
  [[nodiscard]] float radius() const { return x_[0]; }
  [[nodiscard]] float spread() const { return spread_; }  ///< square of how much larger residuals are than sigmas say

 private:
  std::array<float, packed_size(kUnknowns)> matrix_{};
  std::array<float, kUnknowns> rhs_{};
  std::array<float, kUnknowns> x_{};
  float spread_ = 1;
  float scale_ = 1;  ///< of sigmas in this pass
  RadiusPrior radius_;
  Spread sums_;
  std::uint8_t tangents_ = 0;
};

extern template class LowOrderFit<3>;
extern template class LowOrderFit<5>;

}  // namespace fencepost::recon
