// How well the poses of a log are known.
#pragma once

namespace fencepost::host {

/// Sigmas of one pose, each exposure anew.
struct PoseNoise {
  double position = 0;  ///< m
  double heading = 0;   ///< rad
};

}  // namespace fencepost::host
