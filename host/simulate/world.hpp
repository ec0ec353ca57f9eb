// A scene's objects at a time: they move, come and go.
#pragma once

#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::host {

/// The objects of a scene over time. Cost: nothing while no object of the scene moves, comes or goes.
class World {
 public:
  explicit World(const Scene& scene);

  /// In the scene's order, with the footprints of that time; absent objects have none. Valid until the next call.
  const std::vector<SceneObject>& at(double t);

 private:
  const Scene& scene_;
  bool still_;
  std::vector<SceneObject> objects_;
};

/// The object's footprint at t, map frame; empty: it is not there.
Polygon footprint_at(const SceneObject& object, double t);

}  // namespace fencepost::host
