// Online and optimum against the truth of a scene, each aligned by itself.
#pragma once

#include <string>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"
#include "host/smooth/smooth.hpp"
#include "host/smooth/smooth_evaluation.hpp"

namespace fencepost::host {

/// A true object's counterpart: the only object of its signature that was seen most, where the scene has the signature
/// once; otherwise as `evaluate` matches.
TruthPar truth_par(const ResultDocument& map, const Scene& truth);

SmoothEvaluation evaluate_smoothed(const Smoothed& smoothed, const Scene& truth, const std::string& log_name);

std::string smooth_evaluation_text(const std::vector<SmoothEvaluation>& evaluations);
/// The evaluation's JSON with a key `smooth`: one entry a log.
std::string with_smooth_json(const std::string& evaluation, const std::vector<SmoothEvaluation>& evaluations);

}  // namespace fencepost::host
