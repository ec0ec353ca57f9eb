// An estimated footprint as a ring.
#pragma once

#include "host/calibrate/parameters.hpp"
#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// The points that touch the tangents of the support function, map, m, counter-clockwise.
LinearRing outline_of(const ObjectValues& object);

}  // namespace fencepost::host
