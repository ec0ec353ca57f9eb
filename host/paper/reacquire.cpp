#include "host/paper/reacquire.hpp"

#include <algorithm>
#include <numeric>

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

Reacquisition reacquire(const Tour& tour, RegionRenderer& renderer, const std::vector<Solid>& world,
                        std::size_t landmark, std::size_t frame) {
  Reacquisition result;
  const RealImage& image = tour.images[frame];
  result.rendered = renderer.render(world, lens_at(tour.scene.camera, believed_pose(tour, frame)))[landmark];
  LandmarkTruth truth{is_whole_in(image, landmark), false};
  if (result.rendered) {
    result.match = match_landmark(*result.rendered, image.regions, tour.scene.camera.width);
    truth.is_match = result.match->region && is_of(image.truths[*result.match->region], landmark);
  }
  result.outcome = outcome_of(result.match, truth);
  return result;
}

Sequence reacquire_all(const Tour& tour, RegionRenderer& renderer, const std::vector<Solid>& world) {
  Sequence sequence;
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    std::vector<Reacquisition>& one = sequence.emplace_back();
    for (std::size_t f = 0; f < tour.frames.size(); ++f) one.push_back(reacquire(tour, renderer, world, landmark, f));
  }
  return sequence;
}

void ReacquisitionScore::add(const Sequence& sequence) {
  for (std::size_t landmark = 0; landmark < sequence.size(); ++landmark) {
    for (const Reacquisition& one : sequence[landmark]) {
      landmarks[landmark].add(one.outcome);
      if (one.outcome == MatchOutcome::kMatched) {
        right_errors.push_back(one.match->error);
        right_confidences.push_back(one.match->match_confidence);
      }
      if (one.outcome == MatchOutcome::kMismatched) wrong_confidences.push_back(one.match->match_confidence);
    }
  }
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

}  // namespace fencepost::host
