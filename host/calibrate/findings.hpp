// Which of the numbers a log has told, how well, and what would have told the others.
#pragma once

#include <array>
#include <vector>

#include "host/calibrate/calibrate.hpp"
#include "host/calibrate/solver.hpp"

namespace fencepost::host {

/// What is held at what was told: what is impossible to tell, and what is essential and this log did not tell. All else
/// that it hardly tells stays near what was told by itself, and goes on sharing the errors. `matrix`: variances of the
/// whole problem.
std::array<bool, kCalibrated> to_be_held(const CalibrationProblem& problem, const SolverOptions& impossible,
                                         const CalibratedMatrix& matrix);

/// The largest error that a map does not notice, of camera or wheels, in the parameter's unit.
double of_use(std::size_t index);

/// In the order and the units in which people read them.
std::vector<Finding> findings_of(const CalibrationProblem& problem, const Estimate& estimate,
                                 const CalibratedMatrix& matrix, const std::array<bool, kCalibrated>& held);

/// The told calibration with what was found, within the record's ranges.
sensor::CameraIntrinsics calibrated(const sensor::CameraIntrinsics& told, const Estimate& estimate,
                                    const std::array<bool, kCalibrated>& held);

}  // namespace fencepost::host
