// The optimum as a result document, and the online map beside it.
#pragma once

#include "host/calibrate/drive_log.hpp"
#include "host/calibrate/solver.hpp"
#include "host/calibrate/start.hpp"
#include "host/smooth/smooth.hpp"

namespace fencepost::host {

std::vector<SmoothedObject> optimum_objects(const StartedProblem& started, const SolverOptions& options);

/// Objects and path of the optimum with what else the online document says of the log. Alerts, guard and doubts are the
/// robot's own and stay there.
ResultDocument optimum_result(const ResultDocument& online, const DriveLog& log, const StartedProblem& started,
                              const std::vector<SmoothedObject>& objects);

/// Aligns; the online outlines, moved onto the optimum, become models `online` of its objects.
Par compare_online(const ResultDocument& online, ResultDocument& optimum);

}  // namespace fencepost::host
