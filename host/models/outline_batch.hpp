// Fits the outlines of up to four objects at once, to the same bits as HybridSolver one after the other. A processor
// with vectors needs a fraction of the time. All tangents of an object are weighed side by side (tangent_terms). Work
// that goes row by row is done for four objects at a time (lanes).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"
#include "host/models/lanes.hpp"
#include "host/models/tangent_terms.hpp"

namespace fencepost::recon {

/// 64 KB, and nothing in it outlives solve(): for a stack that has them.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): each pass writes what it reads; clearing all takes as long
class OutlineBatch {
 public:
  static constexpr std::size_t kCapacity = kLanes;
  /// With fewer views the fit is another one, and soon done.
  static bool takes(const HybridCore& hybrid) { return hybrid.views >= kViewsForPolygon; }

  [[nodiscard]] bool full() const { return count_ == kLanes; }
  /// `known_radius`: of the object, m; 0: not known. Not when full.
  void add(Hybrid<kRing>& hybrid, float known_radius);
  /// All that were added: as HybridSolver<64, 3>::solve() would leave them. Then there are none.
  void solve();

 private:
  using Coefficients = std::array<float, kSeries>;

  // An object's data in all passes.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): gathered before it is read
  struct Outline {
    Hybrid<kRing>* hybrid = nullptr;
    RadiusPrior radius_prior;
    bool refused = false;  // the series was ill-conditioned
    bool stopped = false;  // the ring was: the result of the passes before is kept
    float spread = 1;
    Coefficients x{};  // of the series
    float radius = 0;  // the same in a sensible range
    RingOffsets offsets{};
    std::array<std::uint8_t, kRing> sigmas{};
    SeriesTangents series;
    RingTangents ring;
  };

  void fit_series();
  void weigh_series(std::size_t lane, std::size_t pass, SeriesSums& sums);
  void solve_series();
  void begin_rings();
  void weigh_ring(std::size_t lane, std::size_t pass);
  void solve_rings();
  void measure();
  void learn_spreads();
  void publish(Outline& outline);

  std::array<RingEquations, kLanes> equations_;
  std::array<TangentTerms, kLanes> terms_;
  std::array<Outline, kLanes> outlines_;
  // Terms of all lanes; lanes without an object have those of the first one.
  std::array<Lanes, kSeries> rhs_;
  std::array<Lanes, packed_size(kSeries)> matrix_;
  std::size_t count_ = 0;
};

}  // namespace fencepost::recon
