// The faces of a solid that a camera can see, as polygons of the image.
#pragma once

#include <vector>

#include "host/render/solid.hpp"
#include "host/simulate/prism.hpp"

namespace fencepost::host {

/// Where things appear: pixel coordinates (u right, v down) of a camera of any pitch, without distortion.
struct Projection {
  CameraPose lens;
  double pitch = 0;  ///< rad, positive = looking down
  double fx = 1;     ///< px
  double fy = 1;
  double cx = 0;
  double cy = 0;
};

/// Image position of (distance ahead along the optical axis, left, up), all m from the lens; ahead > 0.
Point project(const Projection& projection, double ahead, double left, double up);

struct Face {
  std::vector<LinearRing> rings;  ///< px; the outer one and holes
  double light = 1;               ///< 0 to 1: how bright this face is
  double distance = 0;            ///< m, of its middle from the lens
};

/// Walls that face the lens, farthest first, then the lid or the underside if that is in sight. Cut off in front of the
/// lens. Light comes from the upper left of the map.
std::vector<Face> visible_faces(const Solid& solid, const Projection& projection);

}  // namespace fencepost::host
