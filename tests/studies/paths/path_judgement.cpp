#include "tests/studies/paths/path_judgement.hpp"

#include <cmath>
#include <stdexcept>

namespace fencepost::test {
namespace {

host::Score score_of(const ObjectScores& object, const std::string& model) {
  const auto found = object.find(model);
  return found == object.end() ? host::Score{} : found->second;
}

/// The standard error of the mean over all objects, with scenes as units. Scenes may differ in their number of objects.
double standard_error(std::span<const SceneScores> scenes, const std::string& model, double mean, double objects) {
  double squares = 0;
  double counted = 0;
  for (const SceneScores& scene : scenes) {
    if (scene.empty()) continue;
    double off = 0;
    for (const ObjectScores& object : scene) {
      const host::Score score = score_of(object, model);
      off += 100 * (score.recklessness + score.paranoia) - mean;
    }
    squares += off * off;
    ++counted;
  }
  if (counted < 2) throw std::runtime_error("a judgement needs two scenes or more with objects");
  return std::sqrt(squares * counted / (counted - 1)) / objects;
}

}  // namespace

PathMean mean_of(std::span<const SceneScores> scenes, const std::string& model) {
  PathMean mean;
  double objects = 0;
  for (const SceneScores& scene : scenes) {
    for (const ObjectScores& object : scene) {
      const host::Score score = score_of(object, model);
      mean.recklessness += 100 * score.recklessness;
      mean.paranoia += 100 * score.paranoia;
      ++objects;
    }
  }
  if (objects > 0) mean.recklessness /= objects;
  if (objects > 0) mean.paranoia /= objects;
  mean.standard_error = standard_error(scenes, model, mean.sum(), objects);
  return mean;
}

bool reaches(const PathMean& hybrid, const PathReference& reference) {
  const double error = std::hypot(hybrid.standard_error, reference.standard_error);
  return hybrid.sum() - reference.hybrid_with_rows <= error;
}

}  // namespace fencepost::test
