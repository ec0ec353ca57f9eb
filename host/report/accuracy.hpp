// The models' errors, where the ground truth is known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

struct ObjectAccuracy {
  std::uint32_t id = 0;
  std::size_t truth = 0;                 ///< index into Scene::objects
  std::optional<double> position_error;  ///< m, from the footprint's centroid to the cylinder's centre
  std::vector<ModelScore> models;
};

/// Each object matched to a true one, as `fencepost evaluate` matches and measures them; in order of ids.
std::vector<ObjectAccuracy> measure_accuracy(const ResultDocument& document, const Scene& truth);

/// As a table; names missed true objects and phantoms.
std::string accuracy_table(const ResultDocument& document, const Scene& truth);

}  // namespace fencepost::host
