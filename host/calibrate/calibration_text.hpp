// A calibration to read, and as JSON.
#pragma once

#include <string>

#include "host/calibrate/calibrate.hpp"

namespace fencepost::host {

/// A table of the configured and the estimated numbers, residuals before and after, and what to drive for the rest.
/// Then the $FPCAM line, and the $FPSIG lines of colours whose pad was found.
std::string calibration_text(const Calibration& calibration, const std::string& log_name);

/// The same as one line of JSON; the layout is in share/doc/calibrate.md.
std::string calibration_json(const Calibration& calibration);

}  // namespace fencepost::host
