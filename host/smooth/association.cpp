#include "host/smooth/association.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "host/calibrate/regroup.hpp"
#include "host/calibrate/residuals.hpp"

namespace fencepost::host {
namespace {

constexpr double kFits = 4;        ///< sigmas: within them a spare box is an object's
constexpr double kFitsNoMore = 8;  ///< sigmas: beyond them a box is not its object's any more

/// The largest misfit of the box's middle, width and foot, in sigmas; of one edge if the other is missing.
double misfit(const StartedProblem& started, Sighting sighting, std::size_t object) {
  constexpr double kBehind = 1e9;
  sighting.object = object;
  const SightingResidual residual = residual_of(started.problem, started.estimate, sighting);
  if (residual.ahead <= 0) return kBehind;
  const ImageNoise& noise = started.problem.noise;
  double worst = 0;
  const auto add = [&](double off, double sigma) { worst = std::max(worst, std::abs(off) / sigma); };
  if (residual.left && residual.right) {
    add(0.5 * (*residual.left + *residual.right), noise.middle);
    add(*residual.left - *residual.right, noise.width);
  } else if (residual.left || residual.right) {
    add(residual.left ? *residual.left : *residual.right, noise.edge);
  } else {
    return kBehind;
  }
  if (residual.foot) add(*residual.foot, noise.foot);
  return std::isfinite(worst) ? worst : kBehind;
}

/// Objects that have a box in each frame.
using Taken = std::set<std::pair<double, std::size_t>>;

std::optional<std::size_t> best_object(const StartedProblem& started, const Sighting& sighting, std::uint8_t signature,
                                       const Taken& taken) {
  std::optional<std::size_t> best;
  double least = kFits;
  for (std::size_t o = 0; o < started.signatures.size(); ++o) {
    if (started.signatures[o] != signature || taken.contains({sighting.t, o})) continue;
    const double off = misfit(started, sighting, o);
    if (off >= least) continue;
    least = off;
    best = o;
  }
  return best;
}

struct Pair {
  std::size_t a = 0;
  std::size_t b = 0;
  double apart = 0;
};

/// Nearest first. Odometry that strays may have put one thing at two places.
std::vector<Pair> candidates(const StartedProblem& started) {
  constexpr double kNear = 0.3;         // m
  constexpr double kNearByDrift = 0.2;  // m for each unit of drift
  const std::vector<std::set<double>> times = times_of(started);
  const auto& objects = started.estimate.objects;
  std::vector<Pair> pairs;
  for (std::size_t b = 1; b < objects.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (started.signatures[a] != started.signatures[b]) continue;
      const double apart =
          std::hypot(objects[a][kCentreX] - objects[b][kCentreX], objects[a][kCentreY] - objects[b][kCentreY]);
      if (apart > kNear + kNearByDrift * started.problem.drift) continue;
      if (std::ranges::any_of(times[a], [&](double t) { return times[b].contains(t); })) continue;
      pairs.push_back({a, b, apart});
    }
  }
  std::ranges::sort(pairs, {}, &Pair::apart);
  return pairs;
}

/// The better placed one stays: the one that was seen more.
StartedProblem joined(const StartedProblem& started, std::size_t a, std::size_t b) {
  std::vector<std::size_t> count(started.estimate.objects.size());
  for (const Sighting& sighting : started.problem.sightings) ++count[sighting.object];
  if (count[a] < count[b]) std::swap(a, b);
  StartedProblem one = started;
  std::vector<std::size_t> place(count.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = i == b ? a : i;
  renumber(one, place);
  return one;
}

/// First with wide noise, else a robust sum leaves the far ones where they are.
bool settle(StartedProblem& started, const SolverOptions& options) {
  constexpr double kWide = 8;
  constexpr int kRough = 8;
  const ImageNoise noise = started.problem.noise;
  ImageNoise& wide = started.problem.noise;
  wide = {kWide * noise.middle, kWide * noise.width, kWide * noise.edge, kWide * noise.foot, kWide * noise.top};
  SolverOptions rough = options;
  rough.iterations = kRough;
  const bool failed = solve(started.problem, rough, started.estimate).has_value();
  wide = noise;
  return !failed && !solve(started.problem, options, started.estimate);
}

}  // namespace

Reassigned reassign(StartedProblem& started) {
  Reassigned result;
  Taken taken;
  std::vector<SpareSighting> loose = std::move(started.spare);
  const std::size_t spare_before = loose.size();
  std::vector<Sighting> kept;
  std::vector<std::size_t> was(spare_before, kGone);
  for (const Sighting& sighting : started.problem.sightings) {
    if (misfit(started, sighting, sighting.object) <= kFitsNoMore) {
      kept.push_back(sighting);
      taken.insert({sighting.t, sighting.object});
    } else {
      loose.push_back({sighting, started.signatures[sighting.object]});
      was.push_back(sighting.object);
    }
  }
  started.spare.clear();
  for (std::size_t i = 0; i < loose.size(); ++i) {
    const std::optional<std::size_t> object = best_object(started, loose[i].sighting, loose[i].signature, taken);
    if (!object) {
      started.spare.push_back(loose[i]);
      result.taken_back += was[i] != kGone ? 1U : 0U;
      continue;
    }
    result.added += was[i] == kGone ? 1U : 0U;
    result.moved += was[i] != kGone && was[i] != *object ? 1U : 0U;
    kept.push_back(loose[i].sighting);
    kept.back().object = *object;
    taken.insert({kept.back().t, *object});
  }
  std::ranges::stable_sort(kept, {}, &Sighting::t);
  started.problem.sightings = std::move(kept);
  return result;
}

std::size_t join_by_test(StartedProblem& started, const SolverOptions& options) {
  // Twice this is the change of chi squared: three degrees of freedom would have 16 in one of a thousand. Errors of one
  // object's shape are alike from view to view, so three times that.
  constexpr double kSameCost = 25;
  constexpr int kMaxTrials = 12;  // rounds of joining
  std::size_t went = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> refused;
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    const std::vector<Pair> pairs = candidates(started);
    const auto next = std::ranges::find_if(pairs, [&](const Pair& p) {
      return !refused.contains({started.ids[p.a], started.ids[p.b]});
    });
    if (next == pairs.end()) break;
    const double two = cost_at(started.problem, options, started.estimate);
    StartedProblem one = joined(started, next->a, next->b);
    if (settle(one, options) && cost_at(one.problem, options, one.estimate) <= two + kSameCost) {
      started = std::move(one);
      ++went;
    } else {
      refused.insert({started.ids[next->a], started.ids[next->b]});
    }
  }
  return went;
}

std::size_t drop_lost(StartedProblem& started, std::size_t least) {
  constexpr double kMaxMisfit = 4;  // sigmas, in the median
  std::vector<std::vector<double>> misfits(started.estimate.objects.size());
  for (const Sighting& sighting : started.problem.sightings) {
    misfits[sighting.object].push_back(misfit(started, sighting, sighting.object));
  }
  std::vector<std::size_t> place(misfits.size());
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const bool lost = misfits[i].size() < least || median_of(misfits[i]) > kMaxMisfit;
    place[i] = lost ? kGone : i;
    dropped += lost ? 1U : 0U;
  }
  if (dropped == 0) return 0;
  for (const Sighting& sighting : started.problem.sightings) {
    if (place[sighting.object] == kGone) started.spare.push_back({sighting, started.signatures[sighting.object]});
  }
  renumber(started, place);
  return dropped;
}

}  // namespace fencepost::host
