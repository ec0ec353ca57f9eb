#include "host/evaluate/cut.hpp"

#include <cmath>

#include "host/evaluate/metrics.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {

Cut cut_of(const ObjectResult& object, const Polygon& footprint, bool end) {
  Cut cut{object.views, end, std::nullopt, {}, object.confidence};
  if (const Circle* circle = object_circle(object)) {
    const Point center = centroid(footprint);
    cut.position_error = std::hypot(circle->center.x - center.x, circle->center.y - center.y);
  }
  for (const ModelResult& model : object.models) cut.models.push_back({model.name, score(model.geometry, footprint)});
  return cut;
}

}  // namespace fencepost::host
