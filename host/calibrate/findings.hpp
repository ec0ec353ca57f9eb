// Which numbers a log determines, how well, and which drive would determine the others.
#pragma once

#include <array>
#include <vector>

#include "host/calibrate/calibrate.hpp"
#include "host/calibrate/solver.hpp"

namespace fencepost::host {

/// Parameters that are held at the configured value: impossible ones, and essential ones that this log does not
/// determine. A weak one that is not essential stays free: its prior keeps it near the configured value, and it shares
/// the errors. `matrix`: variances of the whole problem.
std::array<bool, kCalibrated> to_be_held(const CalibrationProblem& problem, const SolverOptions& impossible,
                                         const CalibratedMatrix& matrix);

/// The largest error that a map does not notice, of camera or wheels, in the parameter's unit.
double of_use(std::size_t index);

/// In the order and the units in which people read them.
std::vector<Finding> findings_of(const CalibrationProblem& problem, const Estimate& estimate,
                                 const CalibratedMatrix& matrix, const std::array<bool, kCalibrated>& held);

/// The configured calibration with what was found, within the record's ranges.
sensor::CameraIntrinsics calibrated(const sensor::CameraIntrinsics& configured, const Estimate& estimate,
                                    const std::array<bool, kCalibrated>& held);

}  // namespace fencepost::host
