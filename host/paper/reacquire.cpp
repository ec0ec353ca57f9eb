#include "host/paper/reacquire.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/evaluate/metrics.hpp"
#include "host/geometry/planar.hpp"
#include "host/paper/blocks_world.hpp"

namespace fencepost::host {

Models reconstruct(const Tour& tour, std::size_t blocks, const std::vector<std::size_t>& after) {
  Models models;
  for (std::size_t block = 0; block < blocks; ++block) models.given.push_back(follow_given(tour, block, after));
  const auto& all = algorithms();
  if (std::any_of(all.begin(), all.end(), [](const Algorithm& a) { return a.inferred; })) {
    models.inferred = follow_inferred(tour, after);
    models.inferred.resize(blocks);
  }
  return models;
}

std::vector<Solid> world_of(const Tour& tour, const Models& models, const Algorithm& algorithm, std::size_t snapshot) {
  std::vector<Solid> world;
  for (std::size_t block = 0; block < models.given.size(); ++block) {
    const History& history = models.of(algorithm, block);
    world.push_back(solid_of_model(tour, history, history.snapshots[snapshot], algorithm.model, block));
  }
  return world;
}

std::vector<Reacquisition> reacquire_both(const Tour& tour, RegionRenderer& renderer, const std::vector<Solid>& world,
                                          std::size_t frame) {
  const RealImage& image = tour.images[frame];
  const auto rendered = renderer.render(world, lens_at(tour.scene.camera, believed_pose(tour, frame)));
  std::vector<Reacquisition> both;
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    Reacquisition& result = both.emplace_back();
    LandmarkTruth truth{is_whole_in(image, landmark), false};
    result.rendered = rendered[landmark];
    if (result.rendered) {
      result.match = match_landmark(*result.rendered, image.regions, tour.scene.camera.width);
      truth.is_match = result.match->region && is_of(image.truths[*result.match->region], landmark);
    }
    result.outcome = outcome_of(result.match, truth);
  }
  return both;
}

Sequence reacquire_all(const Tour& tour, RegionRenderer& renderer, const std::vector<Solid>& world) {
  Sequence sequence(2);
  for (std::size_t f = 0; f < tour.frames.size(); ++f) {
    const std::vector<Reacquisition> both = reacquire_both(tour, renderer, world, f);
    for (std::size_t landmark = 0; landmark < sequence.size(); ++landmark) sequence[landmark].push_back(both[landmark]);
  }
  return sequence;
}

void ReacquisitionScore::count_empty(const std::vector<Solid>& world) {
  for (std::size_t landmark = 0; landmark < empty.size(); ++landmark) {
    if (area(world[landmark].footprint) < kNoArea) ++empty[landmark];
  }
}

void ReacquisitionScore::add(const Sequence& sequence) {
  OutcomeCounts scene;
  for (std::size_t landmark = 0; landmark < sequence.size(); ++landmark) {
    for (const Reacquisition& one : sequence[landmark]) {
      landmarks[landmark].add(one.outcome);
      scene.add(one.outcome);
      if (one.outcome == MatchOutcome::kMatched) {
        right_errors.push_back(one.match->error);
        right_confidences.push_back(one.match->match_confidence);
        right_margins.push_back(one.match->margin);
      }
      if (one.outcome == MatchOutcome::kMismatched) {
        wrong_confidences.push_back(one.match->match_confidence);
        wrong_margins.push_back(one.match->margin);
      }
    }
  }
  scene_accuracies.push_back(scene.accuracy());
}

OutcomeCounts ReacquisitionScore::all() const {
  OutcomeCounts sum;
  for (const OutcomeCounts& counts : landmarks) sum.add(counts);
  return sum;
}

double area_under_curve(const std::vector<double>& right, const std::vector<double>& wrong) {
  if (right.empty() || wrong.empty()) return 1;
  std::vector<double> sorted = wrong;
  std::sort(sorted.begin(), sorted.end());
  double below = 0;
  for (const double value : right) {
    const auto low = std::lower_bound(sorted.begin(), sorted.end(), value);
    const auto high = std::upper_bound(low, sorted.end(), value);
    below += static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low);
  }
  return below / (static_cast<double>(right.size()) * static_cast<double>(wrong.size()));
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_error(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double center = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - center) * (value - center);
  const auto n = static_cast<double>(values.size());
  return std::sqrt(sum / (n - 1) / n);
}

}  // namespace fencepost::host
