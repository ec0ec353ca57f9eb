// How much the odometry of a log strays and how noisy its image is, by a path that is known better.
#pragma once

#include "host/calibrate/residuals.hpp"

namespace fencepost::host {

/// In units of good wheels (calibration::stray).
struct Strays {
  double drift = 1;  ///< of turns
  double walk = 1;   ///< of ways
};
/// By turns and chords over some seconds, in which the sightings decide, not the odometry itself. With a larger walk
/// than needed, ways take up the bearings' noise, and the map shrinks. Each at least a quarter, at most 60 and 4.
Strays strays_of(const CalibrationProblem& problem, const Estimate& estimate);

/// Noise by the residuals. Of bearings and widths it is at least their difference from one view of an object to its
/// next, both seen from one node. Poses that may stray have taken up a part of the residuals.
ImageNoise image_noise(const CalibrationProblem& problem, const Estimate& estimate);

}  // namespace fencepost::host
