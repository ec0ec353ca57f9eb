#include "host/report/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "host/report/map_objects.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

/// Of the outer ring; a ring without area has its first vertex.
Point centroid(const LinearRing& ring) {
  const double ring_area = signed_area(ring);
  if (ring.empty() || ring_area == 0) return ring.empty() ? Point{} : ring.front();
  Point sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    const double cross = a.x * b.y - b.x * a.y;
    sum = {sum.x + (a.x + b.x) * cross, sum.y + (a.y + b.y) * cross};
  }
  return {sum.x / (6 * ring_area), sum.y / (6 * ring_area)};
}

struct Pair {
  bool tentative = false;
  double distance = 0;
  std::size_t object = 0;
  std::size_t truth = 0;
};

std::vector<Pair> candidate_pairs(const ResultDocument& document, const Scene& scene) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < document.objects.size(); ++i) {
    const ObjectResult& object = document.objects[i];
    const std::optional<Point> at = object_position(object);
    if (!at) continue;
    for (std::size_t j = 0; j < scene.objects.size(); ++j) {
      if (scene.objects[j].signature != object.signature) continue;
      const Point true_centre = centroid(scene.objects[j].footprint.outer);
      pairs.push_back({object.state == record::ObjectState::kTentative,
                       std::hypot(at->x - true_centre.x, at->y - true_centre.y), i, j});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.tentative, a.distance, a.object, a.truth) < std::tie(b.tentative, b.distance, b.object, b.truth);
  });
  return pairs;
}

ModelAccuracy measure_model(const ModelResult& model, const MultiPolygon& footprint) {
  ModelAccuracy accuracy{model.name};
  const double model_area = area(model.geometry);
  const double true_area = area(footprint);
  if (model_area <= 0 || true_area <= 0) return accuracy;
  const double common = intersection_area(model.geometry, footprint);
  accuracy.recklessness = std::clamp(1 - common / true_area, 0.0, 1.0);
  accuracy.paranoia = std::clamp(1 - common / model_area, 0.0, 1.0);
  return accuracy;
}

}  // namespace

std::vector<ObjectAccuracy> measure_accuracy(const ResultDocument& document, const Scene& scene) {
  std::vector<bool> object_taken(document.objects.size());
  std::vector<bool> truth_taken(scene.objects.size());
  std::vector<ObjectAccuracy> all;
  for (const Pair& pair : candidate_pairs(document, scene)) {
    if (object_taken[pair.object] || truth_taken[pair.truth]) continue;
    object_taken[pair.object] = truth_taken[pair.truth] = true;
    const ObjectResult& object = document.objects[pair.object];
    const Polygon& footprint = scene.objects[pair.truth].footprint;
    ObjectAccuracy accuracy{object.id, pair.truth, std::nullopt, {}};
    if (const Circle* circle = object_circle(object)) {
      const Point true_centre = centroid(footprint.outer);
      accuracy.position_error = std::hypot(circle->center.x - true_centre.x, circle->center.y - true_centre.y);
    }
    for (const ModelResult& model : object.models) accuracy.models.push_back(measure_model(model, {footprint}));
    all.push_back(std::move(accuracy));
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

}  // namespace fencepost::host
