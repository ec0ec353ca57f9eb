// The outline as a support polygon: 64 support values, the sides between them never shorter than nothing, few of them
// long. Robust least squares around the ring, in O(64) floats, a little at a time.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/recon/models/hybrid/cyclic_band.hpp"
#include "firmware/recon/models/hybrid/sector_store.hpp"
#include "firmware/recon/models/inlier.hpp"

namespace fencepost::recon {

inline constexpr SpreadPrior kSupportSpread{
    .weight = 8.0F, .expected = 0.6F, .freedoms = 12.0F, .least = 0.02F, .most = 9.0F};

/// Between two neighbours h follows the vertex there: h = [sin(D - t) h_k + sin t h_k+1] / sin D, exactly. The side of
/// direction k has the length (h_k-1 - 2 cos D h_k + h_k+1) / sin D. Solved for as a correction of what is there.
class SupportFit {
 public:
  /// Before the first pass: every support value is set, then begin().
  void set(std::size_t k, float offset) { offsets_[k] = offset; }
  /// `spread`: of a fit before, if it goes on from that.
  void begin(float spread = 1);
  /// Starts one weighing of all tangents; sigmas count `widening` times.
  void begin_pass(float widening);
  /// Adds a tangent; a lower bound counts only where the outline violates it.
  void add(ConstClusters clusters, std::size_t index);
  /// After all tangents of a pass.
  void begin_sides();
  /// Adds the prior of side k. In the first passes all sides have the same length; `polygonal`: few are long.
  void add_side(std::size_t k, bool polygonal);
  void begin_elimination() { band_.begin_elimination(); }
  [[nodiscard]] bool eliminate(std::size_t k) { return band_.eliminate(k); }
  void substitute(std::size_t k) { band_.substitute(k); }
  /// After the last substitution.
  void finish_pass(bool learn_spread);

  [[nodiscard]] float offset(std::size_t k) const { return offsets_[k]; }
  [[nodiscard]] float radius() const { return radius_; }
  [[nodiscard]] float spread() const { return spread_; }
  [[nodiscard]] Vec2 center() const;

 private:
  void measure();

  CyclicBand band_;
  std::array<float, kRing> offsets_{};
  float radius_ = 0;       ///< mean support value, in a sensible range
  float round_side_ = 0;   ///< of a round outline, m
  float side_weight_ = 0;  ///< of the prior of a side
  float spread_ = 1;
  float scale_ = 1;
  Spread sums_;
  std::uint8_t tangents_ = 0;
};

}  // namespace fencepost::recon
