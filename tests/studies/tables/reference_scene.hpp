// The random scenes of the reference figures (reference.csv).
#pragma once

#include "host/scene/scene.hpp"

namespace fencepost::test {

/// Three objects in a disc of 0.35 m radius: rectangle, triangle, round, L; 0.06 to 0.26 m. The camera is level, has
/// 176 px and 43 degrees, and is 15 cm above the floor. Its 75 views are on one circle, 0.8 to 1.1 m from the centre,
/// its heading within 0.05 rad of it. All objects are taller than the lens is high, so no object shows above another
/// one: occlusion is that of the plane. No noise. The same seed gives the same scene.
host::Scene reference_scene(unsigned seed);

inline constexpr int kTourViews = 75;

/// The same views in another order: each some 139 degrees from the one before, so that the first few already come from
/// all around.
host::Scene spread_scene(unsigned seed);

/// Four objects of 0.06 to 0.24 m in a disc of 0.45 m radius. The same camera looks to the robot's left from ovals
/// around them, 75 views each, 0.8 to 1.3 m from the centre.
host::Scene loop_scene(unsigned seed, int loops);

/// The objects and the camera of reference_scene(), and no path.
host::Scene objects_of_reference(unsigned seed);

/// Figure 7: two convex objects in a disc of 0.25 m radius, seen from a circle of 0.95 m. They are a rectangle and a
/// round one, or two rectangles, of 0.12 to 0.2 m. The second one is the one to look at.
host::Scene two_objects_scene(unsigned seed);

}  // namespace fencepost::test
