// A square with things in it, and a robot that stands in a corner of two boards.
#pragma once

#include "host/scene/scene.hpp"
#include "tests/studies/common/noise_levels.hpp"

namespace fencepost::test {

struct Arena {
  host::Scene scene;
  host::TimedPose start;
};

/// 2.4 to 4 m to a side, with six to twelve things of the published tables. Between them, and from the robot, is room
/// for a robot: 0.45 m. The lens sees 60 degrees.
Arena random_arena(unsigned seed, const NoiseLevel& level);

/// Does a round body of that radius (m) touch anything?
bool touches(const Arena& arena, const host::Point& place, double radius);

}  // namespace fencepost::test
