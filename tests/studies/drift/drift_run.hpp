// One random scene with drifting odometry through the product, and how far off pose and models are at the end.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/studies/drift/drifting_odometry.hpp"

namespace fencepost::test {

/// 1 %, 1 deg/m; 3 %, 2 deg/m; 5 %, 3 deg/m; none.
const std::vector<Drift>& drifts();

struct DriftResult {
  double position = 0;                ///< m, mean error over the last quarter of the run
  double heading = 0;                 ///< rad, likewise
  std::map<std::string, double> sum;  ///< R + P by model, robot frame at the end, mean over the objects; % points
};

struct DriftOptions {
  unsigned seed = 1;
  int loops = 1;
  Drift drift;
  std::string correct = "auto";    ///< correct.pose
  std::string configured = "3.0";  ///< correct.drift, %
  std::string profile = "full";
  std::string level = "2";  ///< of blob noise, see noise_levels.hpp; its pose noise is left out
};

/// The robot's log, with `correct.pose` in it. Throws std::runtime_error if the scene cannot be simulated.
std::string drift_log(const DriftOptions& options);

/// Throws std::runtime_error if the scene cannot be simulated or replayed.
DriftResult run_drift(const DriftOptions& options);

}  // namespace fencepost::test
