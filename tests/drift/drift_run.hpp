// One random scene with drifting odometry through the product, and how far off pose and models are at the end.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::test {

/// Odometry as the reference drew it: a scale and a turn a metre, both one draw a run, and a step by step part of each.
struct Drift {
  std::string_view key;
  double scale = 0;      ///< sigma, share of the distance
  double turn = 0;       ///< sigma, degrees a metre
  double turn_walk = 0;  ///< degrees a sqrt(m)
};

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
  bool correct = true;
  std::string profile = "full";
  std::string level = "2";  ///< of blob noise, see noise_levels.hpp; its pose noise is left out
};

/// What the robot would have logged, `correct.pose` in it. Throws std::runtime_error if the scene cannot be simulated.
std::string drift_log(const DriftOptions& options);

/// Throws std::runtime_error if the scene cannot be simulated or replayed.
DriftResult run_drift(const DriftOptions& options);

}  // namespace fencepost::test
