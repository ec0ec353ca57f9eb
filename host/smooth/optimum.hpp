// The optimum as a result document, and the online map beside it.
#pragma once

#include "host/calibrate/drive_log.hpp"
#include "host/calibrate/solver.hpp"
#include "host/calibrate/start.hpp"
#include "host/smooth/smooth.hpp"

namespace fencepost::host {

std::vector<SmoothedObject> optimum_objects(const StartedProblem& started, const SolverOptions& options);

/// The online document with the objects and path of the optimum. Alerts, guard and complaints stay the robot's own.
ResultDocument optimum_result(const ResultDocument& online, const DriveLog& log, const StartedProblem& started,
                              const std::vector<SmoothedObject>& objects);

/// Aligns; the online outlines, moved onto the optimum, become models `online` of its objects.
Par compare_online(const ResultDocument& online, ResultDocument& optimum);

}  // namespace fencepost::host
