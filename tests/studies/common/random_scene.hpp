// Random blocks worlds: the distribution of the published tables (three objects in a 0.35 m disc; box, triangle, round,
// L; 0.06 to 0.26 m; a 176 px, 43 degree camera 15 cm above the floor, one circle of 75 views at 0.8 to 1.1 m).
#pragma once

#include "host/scene/scene.hpp"

namespace fencepost::test {

enum class Colours { kAllDifferent, kAllTheSame };

/// Noise 0 is ideal (integer pixels only), 1 low, 2 medium.
host::Scene random_scene(unsigned seed, int objects, Colours colours, int noise);

}  // namespace fencepost::test
