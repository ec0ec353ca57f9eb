#include "firmware/recon/models/hybrid/hybrid_solver.hpp"

#include <cmath>

#include "firmware/recon/models/hybrid/node_directions.hpp"

namespace fencepost::recon {
namespace {

// Floating-point operations, roughly. A series of u unknowns.
constexpr int work_of_tangent(std::size_t u) { return static_cast<int>(60 + 6 * u + u * (u + 1)); }
constexpr int work_of_value(std::size_t u) { return static_cast<int>(20 + 8 * u); }
constexpr int work_of_row(std::size_t i) { return static_cast<int>(10 + 4 * i + i * i); }
constexpr int work_of_solution(std::size_t u) { return static_cast<int>(4 * u * u); }
constexpr int work_of_node(std::size_t u) { return static_cast<int>(20 + 6 * u + u * u); }
constexpr int kSupportTangentWork = 75;
constexpr int kSideWork = 45;
constexpr int kEliminationWork = 45;
constexpr int kSubstitutionWork = 15;
constexpr int kPassWork = 200;
constexpr int kFinishWork = 300;

std::int16_t offset_steps(float offset) {
  constexpr float kLimit = 3.27F;
  std::int32_t steps = 0;
  static_cast<void>(whole_steps(std::clamp(offset, -kLimit, kLimit), steps));
  return static_cast<std::int16_t>(steps);
}

}  // namespace

void recentre(HybridCore& core, Clusters clusters, std::span<std::int16_t> offsets, const Vec2& center) {
  if (center.squared_norm() <= kRecentre * kRecentre) return;
  constexpr std::int32_t kMapUnitsPerStep = 10;
  const OriginShift shift{offset_steps(center.x()), offset_steps(center.y())};
  core.origin.x += shift.x * kMapUnitsPerStep;
  core.origin.y += shift.y * kMapUnitsPerStep;
  core.last_lens -= Vec2{static_cast<float>(shift.x) * kOffsetStep, static_cast<float>(shift.y) * kOffsetStep};
  move_origin(clusters, shift);
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const std::int32_t moved = offsets[k] - change_of_offset(shift, k, 0, offsets.size());
    offsets[k] = static_cast<std::int16_t>(std::clamp(moved, -kFarthestOffset, kFarthestOffset));
  }
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::begin(HybridType& hybrid, float known_radius) {
  hybrid.new_weight = 0;
  hybrid.fitting = true;
  views_ = hybrid.views;
  low_order_.begin(radius_prior(known_radius));
  passes_ = kLowOrderPasses.size();
  pass_ = views_ < kFewestViews ? static_cast<std::uint8_t>(passes_ - 1) : std::uint8_t{0};
  warm_ = false;
  hybrid.warm_fits = 0;
  begin_low_order_pass();
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::begin_warm(HybridType& hybrid, float known_radius) {
  const auto warm_fits = static_cast<std::uint8_t>(hybrid.warm_fits + 1);
  begin(hybrid, known_radius);
  if (!hybrid.ok() || views_ < kViewsForPolygon || warm_fits >= kWholeFitEvery) return;
  hybrid.warm_fits = warm_fits;
  warm_ = true;
  pass_ = static_cast<std::uint8_t>(passes_ - kWarmPasses);
  low_order_.clear_series();
  enter(Stage::kOutline);
}

// The series of the outline.
template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::advance_outline(const HybridType& hybrid) {
  constexpr float kShare = 1.0F / static_cast<float>(kSectors);
  low_order_.add_support_value(node_direction(index_, kSectors), hybrid.outline().offset(index_), kShare);
  if (++index_ == kSectors) begin_low_order_pass();
  return work_of_value(series_size(kOrder));
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::begin_low_order_pass() {
  low_order_.begin_pass(kLowOrderPasses[pass_]);
  enter(Stage::kLowOrder);
}

template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::advance(HybridType& hybrid) {
  switch (stage_) {
    case Stage::kDone: return 0;
    case Stage::kOutline: return advance_outline(hybrid);
    case Stage::kLowOrder: return advance_low_order(hybrid);
    case Stage::kFactorise: return advance_factor(hybrid);
    case Stage::kNodes: return advance_nodes(hybrid);
    default: return advance_support(hybrid);
  }
}

template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::advance_low_order(HybridType& hybrid) {
  constexpr std::size_t kUnknowns = series_size(kOrder);
  if (find_cluster(hybrid)) {
    low_order_.add(hybrid.clusters, index_, !doubts());
    ++index_;
    return work_of_tangent(kUnknowns);
  }
  low_order_.begin_solution();
  enter(Stage::kFactorise);
  return 0;
}

template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::advance_factor(HybridType& hybrid) {
  const int work = work_of_row(index_);
  if (!low_order_.factorise(index_)) {
    refuse(hybrid);
    return work;
  }
  if (++index_ < series_size(kOrder)) return work;
  low_order_.finish_pass(doubts() && kLowOrderPasses[pass_] <= kLearningWidening);
  if (++pass_ < passes_) {
    begin_low_order_pass();
  } else {
    enter(Stage::kNodes);
  }
  return work + work_of_solution(series_size(kOrder));
}

// Sigmas and offsets of the low order, all around.
template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::advance_nodes(HybridType& hybrid) {
  const Vec2 direction = node_direction(index_, kSectors);
  const auto [offset, sigma] = low_order_.at(direction);
  sigmas_[index_] = encode_sigma(sigma);
  if constexpr (kPolygon) {
    support_.set(index_, warm_ ? hybrid.outline().offset(index_) : offset);
  } else {
    offsets_[index_] = offset_steps(offset);
  }
  constexpr int kWork = 2 * work_of_node(series_size(kOrder));
  if (++index_ < kSectors) return kWork;
  if constexpr (kPolygon) {
    const float spread = decode_sigma(hybrid.spread);
    support_.begin(warm_ ? spread * spread : 1.0F);
    if (views_ >= kViewsForPolygon) {
      passes_ = kSupportPasses.size();
      pass_ = warm_ ? static_cast<std::uint8_t>(passes_ - kWarmPasses) : std::uint8_t{0};
      begin_support_pass();
      return kWork;
    }
    for (std::size_t k = 0; k < kSectors; ++k) hybrid.offsets[k] = offset_steps(support_.offset(k));
  } else {
    hybrid.offsets = offsets_;
  }
  finish(hybrid, low_order_.center(), low_order_.spread());
  return kWork + kFinishWork;
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::begin_support_pass() {
  if constexpr (kPolygon) support_.begin_pass(kSupportPasses[pass_]);
  enter(Stage::kTangents);
}

template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::advance_support(HybridType& hybrid) {
  if constexpr (kPolygon) {
    switch (stage_) {
      case Stage::kTangents:
        if (!find_cluster(hybrid)) {
          support_.begin_sides();
          enter(Stage::kSides);
          return 0;
        }
        support_.add(hybrid.clusters, index_++);
        return kSupportTangentWork;
      case Stage::kSides:
        support_.add_side(index_, pass_ >= kPolygonalFrom);
        if (++index_ < kRing) return kSideWork;
        support_.begin_elimination();
        enter(Stage::kEliminate);
        return kSideWork;
      case Stage::kEliminate:
        if (!support_.eliminate(index_)) {  // the last good pass stands; at worst it is the low order
          publish(hybrid);
          return kEliminationWork + kFinishWork;
        }
        if (++index_ == kRing) enter(Stage::kSubstitute);
        return kEliminationWork;
      case Stage::kSubstitute:
        support_.substitute(kRing - 1 - index_);
        if (++index_ < kRing) return kSubstitutionWork;
        return kSubstitutionWork + finish_support_pass(hybrid);
      default: return 0;
    }
  }
  return 0;
}

template <std::size_t kSectors, std::size_t kOrder>
int HybridSolver<kSectors, kOrder>::finish_support_pass(HybridType& hybrid) {
  if constexpr (kPolygon) {
    support_.finish_pass(kSupportPasses[pass_] <= kLearningWidening);
    if (++pass_ < passes_) {
      begin_support_pass();
      return kPassWork;
    }
    publish(hybrid);
    return kPassWork + kFinishWork;
  }
  return 0;
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::publish(HybridType& hybrid) {
  if constexpr (kPolygon) {
    for (std::size_t k = 0; k < kSectors; ++k) hybrid.offsets[k] = offset_steps(support_.offset(k));
    finish(hybrid, support_.center(), support_.spread());
  }
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::finish(HybridType& hybrid, const Vec2& center, float spread) {
  take_fit(hybrid, sigmas_, center, spread);
  stage_ = Stage::kDone;
}

template <std::size_t kSectors, std::size_t kOrder>
void HybridSolver<kSectors, kOrder>::refuse(HybridType& hybrid) {
  refuse_fit(hybrid);
  stage_ = Stage::kDone;
}

template class HybridSolver<64, 3>;
template class HybridSolver<32, 5>;

}  // namespace fencepost::recon
