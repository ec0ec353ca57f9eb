// Small worlds for the tests of the measures: axis-parallel boxes, hand-made results.
#pragma once

#include <utility>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host::testing {

inline LinearRing box_ring(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}
inline Polygon box(double x, double y, double width, double height) { return {box_ring(x, y, width, height), {}}; }

/// A confirmed object with a cylinder of 64 vertices' worth of nothing: only its centre matters here.
inline ObjectResult at(std::uint32_t id, std::uint8_t signature, Point center) {
  ObjectResult object{id, signature, record::ObjectState::kConfirmed, 9, 0, 0.2, 0.9, {}};
  ModelResult cylinder;
  cylinder.name = "cylinder";
  cylinder.circle = Circle{center, 0.05};
  object.models = {cylinder};
  return object;
}

/// Squares of 0.1 m side around these points: circumscribed radius 0.0707 m.
inline Scene squares(const std::vector<std::pair<std::uint8_t, Point>>& places) {
  Scene scene;
  for (const auto& [signature, center] : places) {
    scene.objects.push_back({"box", signature, 0, 0.2, box(center.x - 0.05, center.y - 0.05, 0.1, 0.1)});
  }
  return scene;
}

}  // namespace fencepost::host::testing
