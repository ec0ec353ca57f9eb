// Random blocks worlds, by the distribution of the published tables. Three objects are in a 0.35 m disc: box, triangle,
// round, L; 0.06 to 0.26 m. The camera has 176 px and 43 degrees and is 15 cm above the floor. Its 75 views are from
// one circle at 0.8 to 1.1 m.
#pragma once

#include "host/scene/scene.hpp"

namespace fencepost::test {

enum class Colours { kAllDifferent, kAllTheSame };

/// Noise 0 is ideal (integer pixels only), 1 low, 2 medium.
host::Scene random_scene(unsigned seed, int objects, Colours colours, int noise);

}  // namespace fencepost::test
