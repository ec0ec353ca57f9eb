// A path of points as a car drives it: straight on, and round each point in an arc.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::host {

/// The points in the order in which they are driven, laps unrolled.
std::vector<Point> driven_points(const WaypointPath& path);

/// The first point, an index into path.points, whose arc does not fit between its neighbours'.
std::optional<std::size_t> corner_without_room(const WaypointPath& path);

/// Poses to be joined linearly, at most 2 degrees apart in an arc. `path.turn_radius` is not 0, and all corners fit.
std::vector<TimedPose> rounded_knots(const WaypointPath& path);

}  // namespace fencepost::host
