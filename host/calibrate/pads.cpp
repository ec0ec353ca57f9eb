#include "host/calibrate/pads.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace fencepost::host {
namespace {

/// Objects of each kind.
std::vector<std::size_t> counts_of(const CalibrationProblem& problem, std::size_t kinds) {
  std::vector<std::size_t> counts(kinds);
  for (const std::size_t kind : problem.kinds) ++counts[kind];
  return counts;
}

/// Kinds of few objects become one; all become one if those are still too few.
void join_small(CalibrationProblem& problem, const std::vector<std::size_t>& counts) {
  const auto is_small = [&](std::size_t kind) { return counts[kind] < kMinPadObjects; };
  const auto small = static_cast<std::size_t>(std::ranges::count_if(problem.kinds, is_small));
  if (small == 0) return;
  const bool all = small < kMinPadObjects;
  const std::size_t shared = *std::ranges::find_if(problem.kinds, is_small);
  for (std::size_t& kind : problem.kinds) {
    if (all || is_small(kind)) kind = shared;
  }
}

}  // namespace

std::int8_t whole_pad(double pad) {
  constexpr double kMaxPad = 100;  // as the record has it
  return static_cast<std::int8_t>(std::lround(std::clamp(pad, -kMaxPad, kMaxPad)));
}

void adopt(StartedProblem freed, SolverOptions free, StartedProblem& started, SolverOptions& options,
           std::optional<CalibratedMatrix>& matrix) {
  freed.problem.noise = noise_of(residuals_at(freed.problem, freed.estimate));
  if (solve(freed.problem, free, freed.estimate)) return;
  started = std::move(freed);
  options = std::move(free);
  matrix = covariance_at(started.problem, options, started.estimate);
}

void free_pads(StartedProblem& started, SolverOptions& options, std::optional<CalibratedMatrix>& matrix) {
  constexpr double kSure = 4;  // sigmas, as of a lens
  StartedProblem freed = started;
  const std::size_t kinds = freed.estimate.kinds.size();
  join_small(freed.problem, counts_of(freed.problem, kinds));
  SolverOptions free = options;
  free.free_kinds.assign(kinds, {});
  const std::vector<std::size_t> counts = counts_of(freed.problem, kinds);
  for (std::size_t k = 0; k < kinds; ++k) free.free_kinds[k][kPad] = counts[k] >= kMinPadObjects;
  if (solve(freed.problem, free, freed.estimate)) return;
  const std::optional<CalibratedMatrix> variances = covariance_at(freed.problem, free, freed.estimate);
  if (!variances) return;
  bool any = false;
  for (std::size_t k = 0; k < kinds; ++k) {
    double& pad = freed.estimate.kinds[k][kPad];
    const double variance = (*variances)[place_of(k, kPad)][place_of(k, kPad)];
    const bool sure = std::abs(pad) >= std::max(kMinPad, kSure * std::sqrt(variance));
    free.free_kinds[k][kPad] = free.free_kinds[k][kPad] && sure;
    if (!free.free_kinds[k][kPad]) pad = 0;
    any = any || free.free_kinds[k][kPad];
  }
  if (!any) return;
  adopt(std::move(freed), std::move(free), started, options, matrix);
}

std::vector<FoundPad> pads_of(const StartedProblem& started, const SolverOptions& options,
                              const CalibratedMatrix& matrix, const std::vector<record::Signature>& signatures) {
  std::map<std::uint8_t, FoundPad> found;
  for (std::size_t o = 0; o < started.signatures.size(); ++o) {
    const std::size_t kind = started.problem.kinds[o];
    if (kind >= options.free_kinds.size() || !options.free_kinds[kind][kPad]) continue;
    FoundPad pad;
    pad.signature = started.signatures[o];
    const auto known = std::ranges::find(signatures, pad.signature, &record::Signature::signature);
    if (known != signatures.end()) pad.configured = known->pad;
    pad.found = pad.configured + started.estimate.kinds[kind][kPad];
    pad.sigma = std::sqrt(matrix[place_of(kind, kPad)][place_of(kind, kPad)]);
    found.emplace(pad.signature, pad);
  }
  std::vector<FoundPad> pads;
  for (const auto& [signature, pad] : found) pads.push_back(pad);
  return pads;
}

std::vector<record::Signature> with_pads(std::vector<record::Signature> signatures, const std::vector<FoundPad>& pads) {
  for (record::Signature& signature : signatures) {
    const auto found = std::ranges::find(pads, signature.signature, &FoundPad::signature);
    if (found != pads.end()) signature.pad = whole_pad(found->found);
  }
  return signatures;
}

}  // namespace fencepost::host
