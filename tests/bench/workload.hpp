// The canonical workload of the reconstruction's kernels: 75 views on an arc of 270 degrees around convex objects.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "firmware/recon/geometry.hpp"
#include "host/geometry/half_planes.hpp"

namespace fencepost::bench {

inline constexpr std::size_t kViews = 75;
inline constexpr std::size_t kMaxObjects = 8;

/// One object in one view: what lies between the two rays from the lens may be the object.
struct View {
  host::Wedge wedge;
  std::array<host::Point, 3> triangle;  ///< the wedge as far as it matters, counter-clockwise
};

/// One object and its views from everywhere; metres, frame of the arena.
struct Views {
  host::LinearRing object;  ///< convex, counter-clockwise
  std::vector<View> views;
};

/// The first `objects` (4 or 8) of the workload's objects. They have 0.1 to 0.3 m and 4 to 24 corners, and are half a
/// metre around the middle of the arena. They are seen from 1.2 m, with edges that are 2 mrad (half a pixel) too wide.
std::vector<Views> workload(std::size_t objects);

/// The square in which all of it happens, the robot's own: counter-clockwise from its lower left corner.
std::array<host::Point, 4> arena();

/// The sides of a view as the robot's kernels take them.
recon::HalfPlane left_side(const View& view);
recon::HalfPlane right_side(const View& view);

}  // namespace fencepost::bench
