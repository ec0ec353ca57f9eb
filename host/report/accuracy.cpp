#include "host/report/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "host/evaluate/matching.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

ObjectAccuracy measure(const ObjectResult& object, std::size_t truth, const Polygon& footprint) {
  ObjectAccuracy accuracy{object.id, truth, std::nullopt, {}};
  if (const Circle* circle = object_circle(object)) {
    const Point centre = centroid(footprint);
    accuracy.position_error = std::hypot(circle->center.x - centre.x, circle->center.y - centre.y);
  }
  for (const ModelResult& model : object.models) {
    accuracy.models.push_back({model.name, score(model.geometry, footprint)});
  }
  return accuracy;
}

}  // namespace

std::vector<ObjectAccuracy> measure_accuracy(const ResultDocument& document, const Scene& scene) {
  const std::vector<std::optional<std::size_t>> matches = match_objects(document.objects, scene);
  std::vector<ObjectAccuracy> all;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i]) all.push_back(measure(document.objects[i], *matches[i], scene.objects[*matches[i]].footprint));
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

}  // namespace fencepost::host
