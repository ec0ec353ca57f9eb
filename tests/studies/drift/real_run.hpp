// One run of a real robot by its wheels alone through the product, and how good the map and the path are at the end.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/real/alignment.hpp"

namespace fencepost::test {

/// A robot of the MRCLAM data sets, beside the checkout (../shared/data).
struct RealRun {
  std::string name;
  std::string folder;
  int robot = 0;
  bool exchanged = false;  ///< landmarks 11 and 17 of the survey are
};

/// Constants may be chosen on D1. Judged: D2, D3, D4, D6_R2, D7_R2.
const std::vector<RealRun>& real_runs();
[[nodiscard]] bool present(const RealRun& run);
/// Its path was surveyed, too.
[[nodiscard]] bool has_survey(const RealRun& run);

struct RealOptions {
  std::string profile = "full";
  std::vector<std::pair<std::string, std::string>> settings;  ///< beside the defaults
  bool rows = false;                                          ///< ranges also as ground rows
  bool widths = false;                                        ///< the signatures' widths are configured
  bool surveyed = false;  ///< by the true poses, where there are any: what correction by itself costs good odometry
  bool robots = false;    ///< the other robots, too, as one signature
};

struct RealResult {
  std::vector<double> landmarks;   ///< m, sorted: how far off they are after the rotation and shift that suit all best
  double map = 0;                  ///< m, their rms
  double scale = 1;                ///< by which the map is too small: without ground rows it is that of the odometry
  double turned = 0;               ///< rad, how the map is turned against the survey's frame, where the start is known
  std::size_t objects = 0;         ///< of landmarks' signatures
  std::size_t missing = 0;         ///< landmarks without an object
  std::size_t movers = 0;          ///< objects of the robots' signature, at the end, that were taken for lasting ones
  std::optional<PathError> path;   ///< where true poses are known
  std::optional<double> textbook;  ///< m, rms of a textbook filter's map; by rows only
};

/// Throws std::runtime_error if the recording cannot be read.
RealResult run_real(const RealRun& run, const RealOptions& options);

}  // namespace fencepost::test
