// One random scene along one path: driven, reconstructed, measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/evaluate/metrics.hpp"
#include "tests/studies/paths/path_scene.hpp"

namespace fencepost::test {

/// How the product gets to its models.
enum class Feed {
  kGiven,      ///< whose each blob is and which ends are hidden comes from the simulator
  kLog,        ///< the log through the whole pipeline
  kCorrected,  ///< likewise, correct.pose on
};

struct PathOptions {
  Path path = Path::kApproach;
  Feed feed = Feed::kLog;
  bool drift = false;  ///< odometry is off by 1 % and 1 degree a metre
  unsigned seed = 1;
  std::string profile = "full";
};

/// Scores by model of each object that was in four views or more. Map frame, which is that of the first pose; an object
/// that is not found has no area.
using ObjectScores = std::map<std::string, host::Score>;

/// Blob noise is that of level 2. Seeds give the same scene, blobs and odometry whatever the feed. Throws
/// std::runtime_error if the scene cannot be simulated or replayed.
std::vector<ObjectScores> run_path(const PathOptions& options);

}  // namespace fencepost::test
