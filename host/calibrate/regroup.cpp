#include "host/calibrate/regroup.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "host/calibrate/residuals.hpp"

namespace fencepost::host {
namespace {

bool together(const std::set<double>& a, const std::set<double>& b) {
  return std::ranges::any_of(a, [&](double t) { return b.contains(t); });
}

std::vector<std::size_t> itself(std::size_t count) {
  std::vector<std::size_t> place(count);
  for (std::size_t i = 0; i < count; ++i) place[i] = i;
  return place;
}

}  // namespace

std::vector<std::set<double>> times_of(const StartedProblem& started) {
  std::vector<std::set<double>> times(started.estimate.objects.size());
  for (const Sighting& sighting : started.problem.sightings) times[sighting.object].insert(sighting.t);
  return times;
}

void renumber(StartedProblem& started, const std::vector<std::size_t>& place) {
  std::vector<std::size_t> index(place.size(), kGone);
  std::vector<ObjectValues> objects;
  std::vector<std::uint8_t> signatures;
  std::vector<std::uint32_t> ids;
  std::vector<double> radii;
  std::vector<std::size_t> kinds;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] != i) continue;
    index[i] = objects.size();
    objects.push_back(started.estimate.objects[i]);
    signatures.push_back(started.signatures[i]);
    ids.push_back(started.ids[i]);
    radii.push_back(started.problem.radii[i]);
    kinds.push_back(started.problem.kinds[i]);
  }
  const auto moved = [&](std::size_t object) { return place[object] == kGone ? kGone : index[place[object]]; };
  std::vector<Sighting>& sightings = started.problem.sightings;
  for (Sighting& sighting : sightings) sighting.object = moved(sighting.object);
  std::erase_if(sightings, [](const Sighting& sighting) { return sighting.object == kGone; });
  auto& sizes = started.problem.sizes;
  for (KnownSize& size : sizes) size.object = moved(size.object);
  std::erase_if(sizes, [](const KnownSize& size) { return size.object == kGone; });
  auto& distances = started.problem.distances;
  for (KnownDistance& apart : distances) {
    apart.a = moved(apart.a);
    apart.b = moved(apart.b);
  }
  std::erase_if(distances, [](const KnownDistance& d) { return d.a == kGone || d.b == kGone || d.a == d.b; });
  started.estimate.objects = std::move(objects);
  started.signatures = std::move(signatures);
  started.ids = std::move(ids);
  started.problem.radii = std::move(radii);
  started.problem.kinds = std::move(kinds);
}

void join_same(StartedProblem& started) {
  constexpr double kPlay = 0.05;  // m beyond both radii: error of a rough fit
  std::vector<std::set<double>> times = times_of(started);
  const std::vector<ObjectValues>& objects = started.estimate.objects;
  std::vector<std::size_t> place = itself(objects.size());
  for (std::size_t b = 1; b < objects.size(); ++b) {
    for (std::size_t a = 0; a < b && place[b] == b; ++a) {
      if (place[a] != a || started.signatures[a] != started.signatures[b]) continue;
      const double apart =
          std::hypot(objects[a][kCentreX] - objects[b][kCentreX], objects[a][kCentreY] - objects[b][kCentreY]);
      if (apart > std::max(objects[a][kRadius], objects[b][kRadius]) + kPlay || together(times[a], times[b])) continue;
      place[b] = a;
      times[a].insert(times[b].begin(), times[b].end());
    }
  }
  renumber(started, place);
}

void drop_at_border(StartedProblem& started) {
  constexpr double kMargin = 4.5;  // px: the border rule's 1.5, and three sigmas of a low noise
  const std::vector<SightingResidual> residuals = residuals_at(started.problem, started.estimate);
  const ConfiguredOptics& optics = started.problem.optics;
  const auto outside = [&](std::optional<double>& end, const std::optional<double>& residual, double size) {
    if (!end || !residual) return;
    const double predicted = *end + *residual;
    if (predicted < kMargin || predicted > size - 1 - kMargin) end.reset();
  };
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    Sighting& sighting = started.problem.sightings[i];
    outside(sighting.left, residuals[i].left, optics.width);
    outside(sighting.right, residuals[i].right, optics.width);
    outside(sighting.foot, residuals[i].foot, optics.height);
    outside(sighting.top, residuals[i].top, optics.height);
  }
}

void drop_unfit(StartedProblem& started) {
  constexpr std::size_t kMin = 2;
  constexpr double kWorse = 5;  // times the usual
  constexpr double kNoise = 3;  // px: below this nothing is unfit
  const std::vector<SightingResidual> residuals = residuals_at(started.problem, started.estimate);
  std::vector<std::vector<double>> of_object(started.estimate.objects.size());
  std::vector<double> all;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    for (const std::optional<double>& edge : {residuals[i].left, residuals[i].right}) {
      if (!edge) continue;
      of_object[started.problem.sightings[i].object].push_back(std::abs(*edge));
      all.push_back(std::abs(*edge));
    }
  }
  const double bound = std::max(kNoise, kWorse * median_of(all));
  std::vector<std::size_t> place = itself(of_object.size());
  std::size_t left = place.size();
  for (std::size_t i = 0; i < place.size() && left > kMin; ++i) {
    if (median_of(of_object[i]) <= bound) continue;
    place[i] = kGone;
    --left;
  }
  renumber(started, place);
}

}  // namespace fencepost::host
