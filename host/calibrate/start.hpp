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

struct StartedProblem {
  CalibrationProblem problem;
  Estimate estimate;
  std::vector<std::uint8_t> signatures;  ///< of each object
  std::size_t frames = 0;                ///< that count
};

/// The problem, or a sentence: what the log lacks, and what to drive.
std::variant<StartedProblem, std::string> start_problem(const DriveLog& log);

/// Why this many objects are not enough, or nothing.
std::optional<std::string> too_few(std::size_t objects);

/// For every refusal: how a log is made that is enough.
inline constexpr const char* kGuide =
    "drive some 20 s and 2 m among 4 blocks, a near and a far one ahead: straight on, once around on the spot, "
    "a curve each way";

}  // namespace fencepost::host
