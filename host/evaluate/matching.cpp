#include "host/evaluate/matching.hpp"

#include <cmath>

#include "host/evaluate/assignment.hpp"
#include "host/evaluate/metrics.hpp"
#include "host/geometry/planar.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using Matches = std::vector<std::optional<std::size_t>>;

/// Distance as a share of the allowed one; kNeverPaired beyond.
double cost(const ObjectResult& object, Point place, const SceneObject& truth) {
  if (truth.signature != object.signature) return kNeverPaired;
  const Point center = centroid(truth.footprint);
  const double share =
      std::hypot(place.x - center.x, place.y - center.y) / (circumscribed_radius(truth.footprint) + kMatchMargin);
  if (share <= 1) return share;
  return kNeverPaired;
}

void match_some(const std::vector<ObjectResult>& objects, const Scene& truth, bool tentative, std::vector<bool>& taken,
                Matches& matches) {
  std::vector<std::size_t> chosen;
  std::vector<std::vector<double>> costs;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if ((objects[i].state == record::ObjectState::kTentative) != tentative) continue;
    const std::optional<Point> place = place_of(objects[i]);
    if (!place) continue;
    chosen.push_back(i);
    std::vector<double>& row = costs.emplace_back();
    for (std::size_t j = 0; j < truth.objects.size(); ++j) {
      row.push_back(taken[j] ? kNeverPaired : cost(objects[i], *place, truth.objects[j]));
    }
  }
  const Matches pairs = pair_cheapest(costs, 1.0);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    matches[chosen[k]] = pairs[k];
    if (pairs[k]) taken[*pairs[k]] = true;
  }
}

}  // namespace

std::optional<Point> place_of(const ObjectResult& object) {
  if (const Circle* circle = object_circle(object)) return circle->center;
  const Polygon* largest = nullptr;
  for (const ModelResult& model : object.models) {
    for (const Polygon& polygon : model.geometry) {
      if (largest == nullptr || area(polygon) > area(*largest)) largest = &polygon;
    }
  }
  if (largest == nullptr || largest->outer.empty()) return std::nullopt;
  return centroid(*largest);
}

Matches match_objects(const std::vector<ObjectResult>& objects, const Scene& truth) {
  Matches matches(objects.size());
  std::vector<bool> taken(truth.objects.size());
  match_some(objects, truth, false, taken, matches);
  match_some(objects, truth, true, taken, matches);
  return matches;
}

}  // namespace fencepost::host
