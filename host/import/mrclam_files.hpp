// The files of one MRCLAM recording, read and checked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/geometry/polygon.hpp"
#include "host/import/import.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// Subjects 1-5 are the robots, 6-20 the landmarks.
inline constexpr int kLastRobot = 5;

struct VelocityRow {
  double t = 0;
  double forward = 0;  ///< m/s, commanded
  double turn = 0;     ///< rad/s
};
struct MeasurementRow {
  double t = 0;
  int barcode = 0;
  double range = 0;
  double bearing = 0;
};

/// Times are seconds from the recording's start, the earliest time in any of its files.
struct MrclamRecording {
  int robot = 0;
  std::vector<VelocityRow> odometry;
  std::vector<TimedPose> truth;
  std::vector<MeasurementRow> measurements;
  std::map<int, int> subject_of;   ///< by barcode
  std::map<int, Point> landmarks;  ///< by subject
};

/// Without `poses_needed` the file of true poses may be missing: `truth` is empty then.
/// errors: ImportProblem, naming file and line
MrclamRecording read_mrclam(const std::string& folder, std::optional<int> robot, bool poses_needed);

/// True pose at `t`, heading the short way round; nothing outside the recorded times. The origin where none are.
std::optional<TimedPose> truth_at(const MrclamRecording& recording, double t);

}  // namespace fencepost::host
