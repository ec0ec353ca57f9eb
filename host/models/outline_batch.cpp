#include "host/models/outline_batch.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/recon/models/hybrid/support_fit.hpp"
#include "firmware/recon/models/hybrid/triangle.hpp"
#include "hal/base/vectors.hpp"
#include "host/models/cyclic_band_whole.hpp"

namespace fencepost::recon {
namespace {

static_assert(kViewsForPolygon >= kFewestViews);

std::int16_t whole_offset(float offset) {
  constexpr float kLimit = 3.27F;
  const float exact = std::clamp(offset, -kLimit, kLimit) / kOffsetStep;
  return static_cast<std::int16_t>(exact < 0 ? exact - 0.5F : exact + 0.5F);
}

// Calls `work` with the count as a constant; mostly it is one.
template <class Work>
void with_count(std::size_t count, const Work& work) {
  switch (count) {
    case 1: return work(std::integral_constant<std::size_t, 1>{});
    case 2: return work(std::integral_constant<std::size_t, 2>{});
    case 3: return work(std::integral_constant<std::size_t, 3>{});
    default: return work(std::integral_constant<std::size_t, 4>{});
  }
}
static_assert(kLanes == 4);

FENCEPOST_FOR_EACH_PROCESSOR
void solve_one(RingEquations& equations, bool& kept) {
  BandFactors<float> factors;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  kept = solve_band(equations, factors);
}

struct LaneEquations {
  using Column = std::array<Lanes, kRing>;
  Column diagonal;
  Column first;
  Column second;
  Column rhs;
};

// Those without an object have the equations of the first one.
FENCEPOST_FOR_EACH_PROCESSOR
void solve_together(std::array<RingEquations, kLanes>& all, std::size_t count, LaneMask& kept) {
  LaneEquations equations;     // NOLINT(cppcoreguidelines-pro-type-member-init)
  BandFactors<Lanes> factors;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const auto lanes_of = [&](RingEquations::Column RingEquations::*column, LaneEquations::Column& lanes) {
    std::array<const float*, kLanes> of{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) of[lane] = (all[lane < count ? lane : 0].*column).data();
    for (std::size_t k = 0; k < kRing; ++k) lanes[k] = Lanes{of[0][k], of[1][k], of[2][k], of[3][k]};
  };
  lanes_of(&RingEquations::diagonal, equations.diagonal);
  lanes_of(&RingEquations::first, equations.first);
  lanes_of(&RingEquations::second, equations.second);
  lanes_of(&RingEquations::rhs, equations.rhs);
  kept = solve_band(equations, factors);
  for (std::size_t lane = 0; lane < count; ++lane) {
    for (std::size_t k = 0; k < kRing; ++k) all[lane].rhs[k] = equations.rhs[k][lane];
  }
}

}  // namespace

void OutlineBatch::add(Hybrid<kRing>& hybrid, float known_radius) {
  Outline& outline = outlines_[count_++];
  outline.hybrid = &hybrid;
  outline.radius_prior = radius_prior(known_radius);
  outline.refused = outline.stopped = false;
  hybrid.new_weight = 0;
  hybrid.fitting = true;
  gather(hybrid.clusters, outline.series, outline.ring);
}

void OutlineBatch::solve() {
  if (count_ == 0) return;
  fit_series();
  begin_rings();
  for (std::size_t pass = 0; pass < kSupportPasses.size(); ++pass) {
    for (std::size_t lane = 0; lane < count_; ++lane) weigh_ring(lane, pass);
    solve_rings();
    measure();
    if (kSupportPasses[pass] <= kLearningWidening) learn_spreads();
  }
  for (std::size_t lane = 0; lane < count_; ++lane) publish(outlines_[lane]);
  count_ = 0;
}

void OutlineBatch::fit_series() {
  for (std::size_t lane = 0; lane < count_; ++lane) {
    outlines_[lane].x.fill(0);
    outlines_[lane].x[0] = outlines_[lane].radius_prior.mean;
    outlines_[lane].spread = kFirstSpread;
  }
  for (std::size_t pass = 0; pass < kLowOrderPasses.size(); ++pass) {
    std::array<Spread, kLanes> spreads;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      SeriesSums sums;  // NOLINT(cppcoreguidelines-pro-type-member-init)
      if (lane < count_) weigh_series(lane, pass, sums);
      spreads[lane] = sums.spread;
      const bool real = lane < count_;
      for (std::size_t i = 0; i < matrix_.size(); ++i) matrix_[i][lane] = real ? sums.matrix[i] : matrix_[i][0];
      for (std::size_t i = 0; i < rhs_.size(); ++i) rhs_[i][lane] = real ? sums.rhs[i] : rhs_[i][0];
    }
    solve_series();
    if (pass == 0 || kLowOrderPasses[pass] > kLearningWidening) continue;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      if (outlines_[lane].series.edges < kTangentsForSpread) continue;
      outlines_[lane].spread = spreads[lane].learnt(kLowOrderSpread);
    }
  }
}

// The first pass believes all.
void OutlineBatch::weigh_series(std::size_t lane, std::size_t pass, SeriesSums& sums) {
  Outline& outline = outlines_[lane];
  const float widening = kLowOrderPasses[pass] * std::sqrt(outline.spread);
  sum_series(outline.series, outline.x, widening, pass == 0, sums);
  add_series_priors(outline.radius_prior, 3, outline.x, sums.matrix, sums.rhs);
}

void OutlineBatch::solve_series() {
  LaneMask kept = {-1, -1, -1, -1};
  for (std::size_t i = 0; i < kSeries; ++i) kept &= factorise_triangle_row<Lanes>(matrix_, i);
  solve_lower_triangle<Lanes, Lanes>(matrix_, rhs_);
  solve_upper_triangle<Lanes, Lanes>(matrix_, rhs_);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    Outline& outline = outlines_[lane];
    outline.refused = outline.refused || kept[lane] == 0;
    for (std::size_t i = 0; i < kSeries; ++i) outline.x[i] += rhs_[i][lane];
  }
}

// Sigmas and offsets of the series, all around.
void OutlineBatch::begin_rings() {
  for (std::size_t lane = 0; lane < count_; ++lane) {
    Outline& outline = outlines_[lane];
    std::array<float, packed_size(kSeries)> factor;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    for (std::size_t i = 0; i < factor.size(); ++i) factor[i] = matrix_[i][lane];
    series_around(outline.x, factor, outline.offsets, outline.sigmas);
    outline.spread = 1;
  }
  measure();
}

void OutlineBatch::weigh_ring(std::size_t lane, std::size_t pass) {
  Outline& outline = outlines_[lane];
  RingEquations& equations = equations_[lane];
  sum_ring(outline.ring, outline.offsets, kSupportPasses[pass] * std::sqrt(outline.spread), equations, terms_[lane]);

  constexpr NodeStep kStep = node_step(kRing);
  const float share = std::clamp(kSharePerTangent * static_cast<float>(outline.series.edges), kMinSideShare, 1.0F);
  const float sigma = kSideSigma * share * outline.radius;
  const RingSides sides{kStep.angle * outline.radius, 1.0F / (sigma * sigma * kStep.angle), pass >= kPolygonalFrom};
  add_sides(outline.offsets, sides, equations);
}

void OutlineBatch::solve_rings() {
  LaneMask kept{};
  if (count_ == 1) {
    bool one_kept = false;
    solve_one(equations_[0], one_kept);
    kept[0] = one_kept ? -1 : 0;
  } else {
    solve_together(equations_, count_, kept);
  }
  for (std::size_t lane = 0; lane < count_; ++lane) {
    Outline& outline = outlines_[lane];
    outline.stopped = outline.stopped || kept[lane] == 0;
    if (outline.stopped) continue;
    for (std::size_t k = 0; k < kRing; ++k) outline.offsets[k] += equations_[lane].rhs[k];
  }
}

// A sum in order takes its time; those of several objects take no more.
void OutlineBatch::measure() {
  with_count(count_, [&](auto count) {
    std::array<float, count()> sums{};
    for (std::size_t k = 0; k < kRing; ++k) {
      for (std::size_t lane = 0; lane < count(); ++lane) sums[lane] += outlines_[lane].offsets[k];
    }
    for (std::size_t lane = 0; lane < count(); ++lane) {
      Outline& outline = outlines_[lane];
      outline.offsets[kRing] = outline.offsets[0];
      outline.radius = std::clamp(sums[lane] / static_cast<float>(kRing), kMinRadius, kLargestPrior);
    }
  });
}

void OutlineBatch::learn_spreads() {
  with_count(count_, [&](auto count) {
    std::array<Spread, count()> sums;
    for (std::size_t k = 0; k < kRing; ++k) {
      for (std::size_t place = k; place < kMaxTangents; place += kRing) {
        for (std::size_t lane = 0; lane < count(); ++lane) {
          sums[lane].squares += terms_[lane].square[place];
          sums[lane].weight += terms_[lane].share[place];
        }
      }
    }
    for (std::size_t lane = 0; lane < count(); ++lane) {
      Outline& outline = outlines_[lane];
      if (outline.stopped || outline.series.edges < kTangentsForSpread) continue;
      outline.spread = sums[lane].learnt(kSupportSpread);
    }
  });
}

void OutlineBatch::publish(Outline& outline) {
  if (outline.refused) return refuse_fit(*outline.hybrid);
  Vec2 center{0, 0};
  for (std::size_t k = 0; k < kRing; ++k) {
    outline.hybrid->offsets[k] = whole_offset(outline.offsets[k]);
    center += outline.offsets[k] * node_direction(k, kRing);
  }
  take_fit(*outline.hybrid, outline.sigmas, center * (2.0F / static_cast<float>(kRing)), outline.spread);
}

}  // namespace fencepost::recon
