// The problem solved by Ceres. The only file that knows it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/problem.hpp"

namespace fencepost::host {

struct SolverOptions {
  /// Held as they are; the first node always is: it is the origin.
  std::array<bool, kCameraParameters> hold_camera{};
  std::array<bool, kWheelParameters> hold_wheels{};
  /// Free parameters of each kind; kinds that are not listed are held.
  std::vector<std::array<bool, kKindParameters>> free_kinds{};
  bool hold_shape = false;  ///< objects stay as round as they are
  bool hold_way = false;    ///< the poses stay where the odometry has them
  int iterations = 60;
};

/// Moves `estimate` to the nearest least sum of robust squares. Answers why it is no use, or nothing.
std::optional<std::string> solve(const CalibrationProblem& problem, const SolverOptions& options, Estimate& estimate);

/// Half the sum of robust squares that `solve` makes least.
double cost_at(const CalibrationProblem& problem, const SolverOptions& options, Estimate estimate);

/// Covariance of an object's place, m^2.
struct PlaceVariance {
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

/// Covariance of each object's place, seen from the first node, priors included. Empty where the problem is singular.
std::vector<PlaceVariance> place_variances(const CalibrationProblem& problem, const SolverOptions& options,
                                           Estimate estimate);

/// Covariance of camera, wheels and kinds at the estimate, priors included: rad, s, m, as in parameters.hpp. Zero for
/// held parameters. Nothing where the problem is singular.
std::optional<CalibratedMatrix> covariance_at(const CalibrationProblem& problem, const SolverOptions& options,
                                              Estimate estimate);

}  // namespace fencepost::host
