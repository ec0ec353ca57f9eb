// How far the models are from the truth, where the truth is known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

struct ModelAccuracy {
  std::string model;
  double recklessness = 1;  ///< share of the true footprint that the model does not enclose
  double paranoia = 1;      ///< share of the model that is not the obstacle
};

struct ObjectAccuracy {
  std::uint32_t id = 0;
  std::size_t truth = 0;                 ///< index into Scene::objects
  std::optional<double> position_error;  ///< m, from the footprint's centroid to the cylinder's centre
  std::vector<ModelAccuracy> models;
};

/// Each found object with the true one of its signature that lies nearest, one to one: pairs are made in order of
/// distance, established objects before tentative ones. A model without area counts 1 and 1.
std::vector<ObjectAccuracy> measure_accuracy(const ResultDocument& document, const Scene& truth);

/// As a table; names what was not found and what is not there.
std::string accuracy_table(const ResultDocument& document, const Scene& truth);

}  // namespace fencepost::host
