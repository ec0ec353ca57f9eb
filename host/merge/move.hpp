// A rigid motion of the plane, of all that a result document has.
#pragma once

#include <cmath>

#include "host/relocation/constellation.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

struct Motion {
  Point rotation{1, 0};  ///< cosine and sine
  Point shift{0, 0};

  static Motion of(const recon::FrameMotion& motion) {
    return {{static_cast<double>(motion.rotation.x()), static_cast<double>(motion.rotation.y())},
            {static_cast<double>(motion.shift.x()), static_cast<double>(motion.shift.y())}};
  }

  [[nodiscard]] double heading() const { return std::atan2(rotation.y, rotation.x); }
  [[nodiscard]] Point of(const Point& p) const {
    return {rotation.x * p.x - rotation.y * p.y + shift.x, rotation.y * p.x + rotation.x * p.y + shift.y};
  }
  [[nodiscard]] PoseResult of(const PoseResult& pose) const {
    const Point place = of(Point{pose.x, pose.y});
    return {pose.t, place.x, place.y, pose.heading + heading()};
  }
  [[nodiscard]] ObjectResult of(ObjectResult object) const {
    for (ModelResult& model : object.models) {
      if (model.circle) model.circle->center = of(model.circle->center);
      for (Polygon& polygon : model.geometry) {
        for (Point& p : polygon.outer) p = of(p);
        for (LinearRing& hole : polygon.holes) {
          for (Point& p : hole) p = of(p);
        }
      }
    }
    return object;
  }
};

}  // namespace fencepost::host
