#include "firmware/recon/models/hybrid/outline_batch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hybrid/cyclic_band_steps.hpp"
#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/recon/models/hybrid/support_fit.hpp"
#include "firmware/recon/models/hybrid/triangle.hpp"

namespace fencepost::recon {
namespace {

static_assert(kViewsForPolygon >= kViewsToDoubt && kViewsForPolygon >= kViewsForShape);

std::int16_t whole_offset(float offset) {
  constexpr float kLimit = 3.27F;
  const float exact = std::clamp(offset, -kLimit, kLimit) / kOffsetStep;
  return static_cast<std::int16_t>(exact < 0 ? exact - 0.5F : exact + 0.5F);
}

}  // namespace

void OutlineBatch::add(Hybrid<kRing>& hybrid, float known_radius) {
  Outline& outline = outlines_[count_++];
  outline.hybrid = &hybrid;
  outline.radius_prior = radius_prior(known_radius);
  outline.refused = outline.stopped = false;
  hybrid.news = false;
  hybrid.fitting = true;
  outline.series.gather(hybrid.clusters);
  outline.ring.gather(hybrid.clusters);
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
  const Widening widening{kLowOrderPasses[pass] * std::sqrt(outline.spread),
                          kMisfit * std::max(0.0F, outline.x[0] - kFitsAny)};
  sum_series(outline.series, outline.x, widening, pass == 0, sums);
  add_series_priors(outline.radius_prior, 3, outline.x, sums.matrix, sums.rhs);
}

void OutlineBatch::solve_series() {
  LaneMask kept = exceeds(Lanes{1, 1, 1, 1}, Lanes{});
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
  const float widening = kSupportPasses[pass];
  const float misfit = widening > 1 ? kFirstMisfit * (widening - 1) * std::max(0.0F, outline.size - kFitsAny) : 0.0F;
  RingEquations& equations = equations_[lane];
  sum_ring(outline.ring, outline.offsets, {widening * std::sqrt(outline.spread), misfit}, equations, terms_[lane]);

  constexpr NodeStep kStep = node_step(kRing);
  const float share = std::clamp(kSharePerTangent * static_cast<float>(outline.series.edges), kLeastSideShare, 1.0F);
  const float sigma = kSideSigma * share * outline.radius;
  const RingSides sides{kStep.angle * outline.radius, 1.0F / (sigma * sigma * kStep.angle), pass >= kPolygonalFrom};
  add_sides(outline.offsets, sides, equations);
}

void OutlineBatch::solve_rings() {
  const auto lanes_of = [this](RingEquations::Column RingEquations::*column, CyclicBandOf<Lanes>::Column& lanes) {
    std::array<const RingEquations::Column*, kLanes> of{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) of[lane] = &(equations_[lane < count_ ? lane : 0].*column);
    for (std::size_t k = 0; k < kRing; ++k) lanes[k] = Lanes{(*of[0])[k], (*of[1])[k], (*of[2])[k], (*of[3])[k]};
  };
  lanes_of(&RingEquations::diagonal, band_.diagonal);
  lanes_of(&RingEquations::first, band_.first);
  lanes_of(&RingEquations::second, band_.second);
  lanes_of(&RingEquations::rhs, band_.rhs);
  band_.begin_elimination();
  LaneMask kept = exceeds(Lanes{1, 1, 1, 1}, Lanes{});
  for (std::size_t k = 0; k < kRing; ++k) kept &= band_.eliminate(k);
  for (std::size_t k = kRing; k-- > 0;) band_.substitute(k);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    Outline& outline = outlines_[lane];
    outline.stopped = outline.stopped || kept[lane] == 0;
    if (outline.stopped) continue;
    for (std::size_t k = 0; k < kRing; ++k) outline.offsets[k] += band_.rhs[k][lane];
  }
}

void OutlineBatch::measure() {
  Lanes sum{};
  for (std::size_t k = 0; k < kRing; ++k) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += outlines_[lane < count_ ? lane : 0].offsets[k];
  }
  for (std::size_t lane = 0; lane < count_; ++lane) {
    Outline& outline = outlines_[lane];
    outline.offsets[kRing] = outline.offsets[0];
    outline.size = sum[lane] / static_cast<float>(kRing);
    outline.radius = std::clamp(outline.size, kLeastRadius, kLargestSideRadius);
  }
}

// A sum in order takes its time; those of several objects take no more.
void OutlineBatch::learn_spreads() {
  std::array<Spread, kLanes> sums;
  for (std::size_t k = 0; k < kRing; ++k) {
    for (std::size_t place = k; place < kMostTangents; place += kRing) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const TangentTerms& terms = terms_[lane < count_ ? lane : 0];
        sums[lane].squares += terms.square[place];
        sums[lane].weight += terms.share[place];
      }
    }
  }
  for (std::size_t lane = 0; lane < count_; ++lane) {
    Outline& outline = outlines_[lane];
    if (outline.stopped || outline.series.edges < kTangentsForSpread) continue;
    outline.spread = sums[lane].learnt(kSupportSpread);
  }
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
