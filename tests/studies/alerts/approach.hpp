// Random approaches: a robot drives along an arc towards blocks in its path and beside it.
#pragma once

#include "host/scene/scene.hpp"
#include "tests/studies/common/noise_levels.hpp"

namespace fencepost::test {

/// Stands for a moment, then drives an arc of constant speed and curvature, for as long as one asks.
struct Drive {
  host::TimedPose start;
  double standing = 0;   ///< s
  double speed = 0.2;    ///< m/s
  double curvature = 0;  ///< 1/m, positive turns left

  [[nodiscard]] host::TimedPose at(double t) const;
  /// The time at which `metres` are behind it.
  [[nodiscard]] double time_of(double metres) const { return standing + metres / speed; }
};

struct Approach {
  host::Scene scene;
  Drive drive;
  double end = 0;  ///< s: the body is about to touch, or the way is at its end
};

/// The same seed gives the same drive, blocks and draws at every level. Footprints and camera are those of the
/// published tables. Speeds are 0.08 to 0.4 m/s, radii from 0.8 m, ways up to 2.2 m; there are one to six blocks of
/// four colours. No block is nearer than `nearest` (m) where the robot starts.
Approach random_approach(unsigned seed, const NoiseLevel& level, double nearest);

/// Distance of a place to the footprint, m; 0 inside.
double distance_to(const host::Polygon& footprint, host::Point place);

}  // namespace fencepost::test
