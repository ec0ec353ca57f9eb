// A calibration to read, and as JSON.
#pragma once

#include <string>

#include "host/calibrate/calibrate.hpp"

namespace fencepost::host {

/// A table of configured and found, residuals before and after, what to drive for the rest, and the $FPCAM line.
std::string calibration_text(const Calibration& calibration, const std::string& log_name);

/// The same as one line of JSON; the layout is in share/doc/calibrate.md.
std::string calibration_json(const Calibration& calibration);

/// The record with its line end.
std::string camera_line(const sensor::CameraIntrinsics& camera);

}  // namespace fencepost::host
