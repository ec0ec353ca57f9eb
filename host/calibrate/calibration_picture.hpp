// A calibration as a drawing.
#pragma once

#include <string>

#include "host/calibrate/calibrate.hpp"

namespace fencepost::host {

/// An SVG: the floor from above, each frame's feet where the old calibration and the new one put them; below, by how
/// much each edge is missed over the image's columns, before and after.
std::string calibration_picture(const Calibration& calibration);

}  // namespace fencepost::host
