// Fits outlines, one at a time and in steps of bounded work. The scratch is here; what comes of it is in the object.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/hybrid/low_order_fit.hpp"
#include "firmware/recon/models/hybrid/support_fit.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {

/// kSectors 64: low order 3, then a support polygon. kSectors 32: the low order alone, a higher one.
template <std::size_t kSectors, std::size_t kOrder>
class HybridSolver {
 public:
  static constexpr bool kPolygon = kSectors == kRing;
  using HybridType = Hybrid<kSectors>;

  /// Starts a fit of `hybrid` from its present tangents. `known_radius`: the configured radius, m; 0: none.
  void begin(HybridType& hybrid, float known_radius = 0);
  /// The same from the outline that is there, where it has enough views, with the last passes alone; each
  /// kWholeFitEvery-th time from nothing. A third of the work.
  void begin_warm(HybridType& hybrid, float known_radius = 0);
  /// Goes on with the object it was begun with: at least one piece of work, and no more than about kWorkPerStep. Its
  /// outline is replaced when the fit is done. True: done, or refused.
  bool step(HybridType& hybrid) {
    int work = 0;
    do {
      work += advance(hybrid);
    } while (work < kWorkPerStep && stage_ != Stage::kDone);
    return stage_ == Stage::kDone;
  }
  /// All steps at once: the same bits.
  void solve(HybridType& hybrid, float known_radius = 0) {
    begin(hybrid, known_radius);
    while (!step(hybrid)) {
    }
  }
  [[nodiscard]] bool done() const { return stage_ == Stage::kDone; }
  /// Gives up the object it was begun with.
  void abandon() { stage_ = Stage::kDone; }

 private:
  enum class Stage : std::uint8_t {
    kDone,
    kOutline,
    kLowOrder,
    kFactorise,
    kNodes,
    kTangents,
    kSides,
    kEliminate,
    kSubstitute
  };

  struct NoSupport {};
  struct NoOffsets {};

  // The first pass of a fit believes all tangents, and so do all as long as there are few views.
  [[nodiscard]] bool doubts() const { return views_ >= kFewestViews && pass_ > 0; }
  // One piece of work; its cost in floating-point operations.
  int advance(HybridType& hybrid);
  int advance_outline(const HybridType& hybrid);
  int advance_low_order(HybridType& hybrid);
  int advance_factor(HybridType& hybrid);
  int advance_nodes(HybridType& hybrid);
  int advance_support(HybridType& hybrid);
  int finish_support_pass(HybridType& hybrid);
  void begin_low_order_pass();
  void begin_support_pass();
  void enter(Stage stage) {
    stage_ = stage;
    index_ = 0;
  }
  void publish(HybridType& hybrid);
  void finish(HybridType& hybrid, const Vec2& center, float spread);
  void refuse(HybridType& hybrid);
  // The next cluster that is not empty, from index_ on; false at the end.
  bool find_cluster(const HybridType& hybrid) {
    while (index_ < hybrid.clusters.size() && hybrid.clusters[index_].views == 0) ++index_;
    return index_ < hybrid.clusters.size();
  }

  LowOrderFit<kOrder> low_order_;
  [[no_unique_address]] std::conditional_t<kPolygon, SupportFit, NoSupport> support_;
  // Until the fit is done the object keeps the outline and the sigmas that it had: alerts read them between two steps.
  std::array<std::uint8_t, kSectors> sigmas_{};
  [[no_unique_address]] std::conditional_t<kPolygon, NoOffsets, std::array<std::int16_t, kSectors>> offsets_{};
  Stage stage_ = Stage::kDone;
  std::uint8_t pass_ = 0;
  std::uint8_t passes_ = 0;
  std::uint8_t views_ = 0;
  std::uint8_t index_ = 0;
  bool warm_ = false;
};

/// Moves the local frame so that `center` becomes its origin, to the next kOffsetStep.
void recentre(HybridCore& core, Clusters clusters, std::span<std::int16_t> offsets, const Vec2& center);

/// The end of a fit whose offsets are in `hybrid` already, in the old local frame.
template <std::size_t kSectors>
void take_fit(Hybrid<kSectors>& hybrid, const std::array<std::uint8_t, kSectors>& sigmas, const Vec2& center,
              float spread) {
  hybrid.sigmas = sigmas;
  hybrid.spread = encode_sigma(std::sqrt(spread));
  hybrid.refusal = HybridRefusal::kNone;
  hybrid.fitting = false;
  recentre(hybrid, hybrid.clusters, hybrid.offsets, center);
  hybrid.known_well = hybrid.outline().known_well();
  hybrid.large = hybrid.outline().radius() > kFitsAny;
}

/// The end of one that is ill-conditioned: the outline stays.
inline void refuse_fit(HybridCore& core) {
  if (core.refusal != HybridRefusal::kNone) core.refusal = HybridRefusal::kIllConditioned;
  core.fitting = false;
}

extern template class HybridSolver<64, 3>;
extern template class HybridSolver<32, 5>;

}  // namespace fencepost::recon
