// The uncertainty of a log's poses.
#pragma once

namespace fencepost::host {

/// Standard deviations of one pose, independent at each exposure.
struct PoseNoise {
  double position = 0;  ///< m
  double heading = 0;   ///< rad
};

}  // namespace fencepost::host
