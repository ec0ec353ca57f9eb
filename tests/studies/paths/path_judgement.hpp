// The models on many scenes along one path, and whether the hybrid is as good as it was meant to be.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/studies/paths/path_reference.hpp"
#include "tests/studies/paths/path_run.hpp"

namespace fencepost::test {

/// The means of one model, points of per cent.
struct PathMean {
  double recklessness = 0;
  double paranoia = 0;
  double standard_error = 0;  ///< of the sum, scenes as units

  [[nodiscard]] double sum() const { return recklessness + paranoia; }
};

/// One scene's objects.
using SceneScores = std::vector<ObjectScores>;

/// Means over all objects of all scenes; a model that is missing has no area. Throws std::runtime_error for fewer than
/// two scenes with objects.
PathMean mean_of(std::span<const SceneScores> scenes, const std::string& model);

/// At or better than the prototype with rows, within one standard error of the difference of two samples.
bool reaches(const PathMean& hybrid, const PathReference& reference);

}  // namespace fencepost::test
