// Landmarks found again: each model rendered from each pose of a tour, and matched with the real image taken there.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/metrics/landmark_match.hpp"
#include "host/paper/algorithm.hpp"
#include "host/paper/history.hpp"
#include "host/render/regions.hpp"

namespace fencepost::host {

/// One landmark, one algorithm, one image.
struct Reacquisition {
  std::optional<Region> rendered;
  std::optional<LandmarkMatch> match;  ///< nothing if it is not rendered
  MatchOutcome outcome = MatchOutcome::kUnseen;
};

/// The models of all blocks of a scene after each of some frame counts, with either kind of flags.
struct Models {
  std::vector<History> given;     ///< by block
  std::vector<History> inferred;  ///< likewise; empty if no algorithm of this build asks for it

  [[nodiscard]] const History& of(const Algorithm& algorithm, std::size_t block) const {
    return algorithm.inferred ? inferred[block] : given[block];
  }
};

Models reconstruct(const Tour& tour, std::size_t blocks, const std::vector<std::size_t>& after);

/// One solid a block: this algorithm's world after `after[snapshot]` frames.
std::vector<Solid> world_of(const Tour& tour, const Models& models, const Algorithm& algorithm, std::size_t snapshot);

/// Renders that world from the robot's believed pose at `frame` and looks for the landmarks (red, yellow) in the real
/// image. All blocks occlude.
std::vector<Reacquisition> reacquire_both(const Tour& tour, RegionRenderer& renderer, const std::vector<Solid>& world,
                                          std::size_t frame);

/// Results by landmark (red, yellow) and frame.
using Sequence = std::vector<std::vector<Reacquisition>>;
Sequence reacquire_all(const Tour& tour, RegionRenderer& renderer, const std::vector<Solid>& world);

/// Decisions of one algorithm over a set of scenes.
struct ReacquisitionScore {
  std::vector<OutcomeCounts> landmarks{2};  ///< red, yellow
  std::vector<double> right_errors;         ///< of matches that were right
  std::vector<double> right_confidences;
  std::vector<double> wrong_confidences;  ///< of mismatches
  std::vector<double> right_margins;
  std::vector<double> wrong_margins;
  std::vector<double> scene_accuracies;  ///< of each sequence added
  std::vector<std::size_t> empty{0, 0};  ///< models without area: red, yellow

  void add(const Sequence& sequence);
  void count_empty(const std::vector<Solid>& world);
  [[nodiscard]] OutcomeCounts all() const;
};

/// Probability that a right one is above a wrong one, ties half (area under the ROC curve); 1 without wrong ones.
double area_under_curve(const std::vector<double>& right, const std::vector<double>& wrong);

double mean(const std::vector<double>& values);  ///< 0 of none
/// Standard error of the mean; 0 for fewer than two.
double standard_error(const std::vector<double>& values);

}  // namespace fencepost::host
