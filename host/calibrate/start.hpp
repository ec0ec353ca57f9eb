// From a log to the problem: which frames count, where the nodes of the way are, where each object is at first.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "host/calibrate/drive_log.hpp"
#include "host/calibrate/problem.hpp"

namespace fencepost::host {

/// A box that no object took.
struct SpareSighting {
  Sighting sighting;
  std::uint8_t signature = 0;
};

struct StartedProblem {
  CalibrationProblem problem;
  Estimate estimate;
  std::vector<std::uint8_t> signatures;  ///< of each object
  std::vector<std::uint32_t> ids;        ///< of each object, the run's own
  std::vector<SpareSighting> spare;      ///< boxes that no object took
  std::size_t frames = 0;                ///< that count
};

/// How much of a log is used.
struct StartOptions {
  std::size_t most_frames = 1500;
  double most_nodes = 1200;
  std::size_t least_views = 8;  ///< minimum of an object; fewer views determine little beyond the object itself
  bool spare = false;           ///< boxes that no object took are kept, too
};

/// Frames, nodes on the odometry's way, sightings of every object that was seen often enough, and where it is by them.
/// `path`, by time: where the nodes are at first; without one where the odometry has them.
StartedProblem start_with(const DriveLog& log, const StartOptions& options, const std::vector<PoseResult>& path);

/// The problem of a calibration, or a sentence: what the log lacks, and what to drive.
std::variant<StartedProblem, std::string> start_problem(const DriveLog& log);

/// Why this many objects are not enough, or nothing.
std::optional<std::string> too_few(std::size_t objects);

/// For every refusal: how a log is made that is enough.
inline constexpr const char* kGuide =
    "drive some 20 s and 2 m among 4 blocks, a near and a far one ahead: straight on, once around on the spot, "
    "a curve each way";

}  // namespace fencepost::host
