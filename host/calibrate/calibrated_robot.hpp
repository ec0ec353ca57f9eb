// The robot file, as --robot takes it, with what was found.
#pragma once

#include <string>

#include "hal/base/result.hpp"
#include "host/calibrate/calibrate.hpp"

namespace fencepost::host {

/// An error in a robot file, as a sentence.
struct RobotProblem {
  std::string message;
};

/// `base`: a robot file whose other numbers stay; empty: none. Wheels are corrected where it has them.
/// errors: the base is no robot file.
base::Result<std::string, RobotProblem> calibrated_robot(const Calibration& calibration, const std::string& base,
                                                         const std::string& base_name);

}  // namespace fencepost::host
