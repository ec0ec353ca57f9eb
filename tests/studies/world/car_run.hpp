// Drives of cars through the product: cycloid's among cones, Victoria Park's among trees.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace fencepost::test {

struct CycloidScore {
  std::size_t cones = 0;    ///< of 8, to which a confirmed object is matched
  std::size_t objects = 0;  ///< confirmed
  double rms = 0;           ///< m, of their places, each frame as it is
  double end_error = 0;     ///< m, of the last pose
};

/// `folder` with 194625.txt and lm.txt. error: std::runtime_error
CycloidScore run_cycloid(const std::string& folder, const std::vector<std::pair<std::string, std::string>>& settings);

struct VictoriaScore {
  double rms = 0;           ///< m of the world, of the path from GPS, after alignment
  double worst = 0;         ///< m of the world
  std::size_t objects = 0;  ///< confirmed
};

/// `folder` with measurements.dat.first_half, inputs.dat.first_half and gps.dat.first_half. error: std::runtime_error
VictoriaScore run_victoria(const std::string& folder, bool rows,
                           const std::vector<std::pair<std::string, std::string>>& settings);

}  // namespace fencepost::test
