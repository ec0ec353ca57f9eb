// A started problem solved in rounds, for `calibrate` and for `doctor`.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/calibrate/solver.hpp"
#include "host/calibrate/start.hpp"

namespace fencepost::host {

inline constexpr int kFitRounds = 5;

/// Factor on the residuals' noise, for what no model has: corners, shadows. Chosen on seeds of the study
/// (tests/studies/calibrate) that it does not use.
inline constexpr double kCaution = 1.15;

/// Holds the parameters that nothing in the log is about.
SolverOptions possible(const CalibrationProblem& problem);

/// The objects alone are estimated.
SolverOptions only_objects();

/// Solves with noise that is measured in between, and objects that turn out to be one joined. Answers why the solver
/// failed, or nothing.
std::optional<std::string> fit(StartedProblem& started, const SolverOptions& options,
                               const std::function<void()>& round_done);

}  // namespace fencepost::host
