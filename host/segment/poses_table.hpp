// The table that says where the robot stood for each image.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::host {

struct ImagePose {
  std::size_t line = 0;  ///< 1-based, for messages
  std::string image;
  TimedPose pose;  ///< of the robot, s, m, rad; t starts at 0 where the table's own is out of the stream's range
};

struct PosesTable {
  std::string file;
  std::vector<ImagePose> rows;              ///< times strictly increasing, images named once
  bool made_up_times = false;               ///< no column t: 0.1 s apart
  bool shifted_times = false;               ///< t counts from the first row
  std::vector<std::string> unused_columns;  ///< by name
  std::vector<std::string> notes;           ///< sentences for the user
  [[nodiscard]] std::string place(const ImagePose& row) const { return file + ":" + std::to_string(row.line); }
};

/// CSV with the columns image, x, y, heading and, if known, t, in any order; other columns are left alone. Blank lines
/// and lines that begin with # are skipped. errors: SegmentProblem with file and line
PosesTable parse_poses(std::string_view text, const std::string& file);

/// Times as the stream can say them: from 0 on, strictly increasing when rounded to 0.1 ms; without any 0.1 s apart.
/// errors: SegmentProblem
void settle_times(PosesTable& table, bool has_time);

}  // namespace fencepost::host
