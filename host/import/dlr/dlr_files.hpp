// The file of DLR's spatial cognition data set, read and checked: odometry, and white discs on the floor.
#pragma once

#include <string>
#include <vector>

namespace fencepost::host {

/// One disc as one image shows it, m in the robot's frame: x forward, y left.
struct DlrDisc {
  double x = 0;
  double y = 0;
  int id = -1;  ///< which disc of the floor; -1: not known
};

/// A motion in the robot's frame before it, then what the image at its end shows.
struct DlrStep {
  double forward = 0;  ///< m
  double left = 0;     ///< m
  double turn = 0;     ///< rad, left positive
  std::vector<DlrDisc> discs;
};

inline constexpr double kDlrPeriod = 0.5;      ///< s a step: the file has no times
inline constexpr double kDlrDiscRadius = 0.1;  ///< m
inline constexpr int kDlrUnknownDisc = 32;     ///< signature of discs that are not known, the last of profile full

/// error: ImportProblem, naming file and line
std::vector<DlrStep> read_dlr(const std::string& path);

}  // namespace fencepost::host
