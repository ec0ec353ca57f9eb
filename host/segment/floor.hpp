// From where a camera was in space to where the robot stood on the floor.
#pragma once

#include <string>
#include <vector>

#include "hal/sensor/camera.hpp"
#include "host/scene/scene.hpp"
#include "host/segment/camera_path.hpp"

namespace fencepost::host {

struct FloorOptions {
  bool of_robot = false;  ///< the poses are the robot's own: x ahead, y left, z up in a world whose z is up
  double scale = 1;       ///< m that one unit of the poses is
  int rotate = 0;         ///< degrees by which the images are turned clockwise before they are used
};

struct OnFloor {
  std::vector<TimedPose> poses;  ///< of the robot, times as given
  double pitch = 0;              ///< rad, down: the camera's, as the poses have it
  double roll = 0;               ///< rad, rms: of the camera's columns against the upright
};

/// The poses show which way is up: a camera that rides upright has its rows, and its way, parallel to the floor. Where
/// it neither turned nor left a straight line, the calibration's pitch does. Where up is within 10 degrees of the
/// world's z, x and y are the world's; else the first pose is the origin. errors: SegmentProblem: rows that lie in no
/// plane, or an unknown direction of up
OnFloor onto_floor(const std::vector<CameraStand>& stands, const sensor::CameraMount& mount,
                   const FloorOptions& options, const std::string& file);

}  // namespace fencepost::host
