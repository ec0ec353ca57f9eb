// The short drive that the guide asks for, with random blocks, and a robot whose configured calibration is wrong.
#pragma once

#include <string>

#include "host/calibrate/calibrate.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::test {

enum class Motion {
  kGuide,     ///< 20 s, 2 m: straight on, once around on the spot, a curve each way
  kSpin,      ///< on the spot only
  kStraight,  ///< straight on only
  kStanding,
  kToAndFro,  ///< straight on between two blocks at either end, `straights` times, half around after each
};

struct DriveOptions {
  unsigned seed = 1;
  Motion motion = Motion::kGuide;
  int blocks = 4;
  int straights = 2;   ///< of kToAndFro, 10 s each
  double noise = 1;    ///< times that of level 1
  double fisheye = 0;  ///< degrees across of an equidistant lens; 0: a Pixy2's
  double drift = 1;    ///< times 1 %, 1 degree/m
  double pad = 0;      ///< px, of all boxes on each side
};

struct CalibrationDrive {
  std::string log;
  host::Scene scene;  ///< with the true camera
  sensor::CameraIntrinsics
      configured;  ///< f off by 5 %, yaw and pitch by 2 degrees, latency by 50 ms, mount by some mm
};

CalibrationDrive calibration_drive(const DriveOptions& options);

/// The true value of a finding by its key, in its unit; the odometry's metre is the unit of length.
double true_value(const CalibrationDrive& drive, std::string_view key);

}  // namespace fencepost::test
