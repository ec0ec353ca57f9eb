// Online and optimum against the truth of a scene, each aligned by itself.
#pragma once

#include <string>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"
#include "host/smooth/smooth.hpp"

namespace fencepost::host {

/// A map against the true footprints.
struct TruthPar {
  std::size_t objects = 0;  ///< in the map, confirmed
  std::size_t pairs = 0;    ///< true objects that it has
  double as_it_stands = 0;  ///< m, rms of the places
  double aligned = 0;       ///< m, after the turn and shift that suit it best
  double worst = 0;         ///< m, of these
};

/// A true object's counterpart: the only object of its signature that was seen most, where the scene has the signature
/// once; otherwise as `evaluate` matches.
TruthPar truth_par(const ResultDocument& map, const Scene& truth);

/// Both maps of one log.
struct SmoothEvaluation {
  std::string log;
  TruthPar online;
  TruthPar optimum;
};
SmoothEvaluation evaluate_smoothed(const Smoothed& smoothed, const Scene& truth, const std::string& log_name);

std::string smooth_evaluation_text(const std::vector<SmoothEvaluation>& evaluations);
/// The evaluation's JSON with a key `smooth`: one entry a log.
std::string with_smooth_json(const std::string& evaluation, const std::vector<SmoothEvaluation>& evaluations);

}  // namespace fencepost::host
