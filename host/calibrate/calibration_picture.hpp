// A calibration as a drawing.
#pragma once

#include <string>

#include "host/calibrate/calibrate.hpp"

namespace fencepost::host {

/// An SVG. Above: the floor from above, with each frame's feet by the old and the new calibration. Below: the residual
/// of each edge over the image's columns, before and after.
std::string calibration_picture(const Calibration& calibration);

}  // namespace fencepost::host
