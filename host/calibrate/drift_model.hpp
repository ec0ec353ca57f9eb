// Random drift of odometry between two nodes; its systematic errors are estimated (WheelParameter).
#pragma once

#include <cmath>

#include "host/calibrate/odometry_track.hpp"

namespace fencepost::host::calibration {

// Random drift of good wheels on a hard floor. Wheels that slip more are noticed: CalibrationProblem::drift, walk.
constexpr double kWalk = 0.004;                 ///< m / sqrt(m)
constexpr double kHeadingWalkByWay = 0.004;     ///< rad / sqrt(m)
constexpr double kHeadingWalkByTurn = 0.004;    ///< rad / sqrt(rad)
constexpr double kPositionResolution = 0.0002;  ///< m
constexpr double kHeadingResolution = 0.0003;   ///< rad

/// Standard deviations of the motion from `a` to `b`: `drift` (of turns) and `walk` (of ways) times those of good
/// wheels. White noise of single samples is no part: the next motion takes a node's error back.
inline PoseNoise stray(const TrackPose& a, const TrackPose& b, double drift, double walk) {
  const double way = std::abs(b.way - a.way);
  const double turn = std::abs(b.heading - a.heading);
  const auto square = [](double value) { return value * value; };
  return {std::sqrt(square(walk * kWalk) * way + square(kPositionResolution)),
          std::sqrt(square(drift * kHeadingWalkByWay) * way + square(drift * kHeadingWalkByTurn) * turn +
                    square(kHeadingResolution))};
}

}  // namespace fencepost::host::calibration
