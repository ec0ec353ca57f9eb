// From what the command line names to a camera and an odometry that the loop can poll.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "hal/linux/clock.hpp"
#include "host/live/device.hpp"
#include "host/live/device_spec.hpp"
#include "host/live/open_port.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host {

struct Devices {
  std::unique_ptr<OdometryDevice> odometry;
  std::unique_ptr<CameraDevice> camera;
  /// The camera's own profile with the robot's numbers over it; empty where the console has to tell it.
  std::optional<sensor::CameraIntrinsics> intrinsics;
};

/// `clock`: the one that the loop reads. `wait`: a device that is not there is awaited, instead of a failure.
/// errors: DeviceFailure: a sentence that says what, where and what to try.
std::variant<Devices, DeviceFailure> open_devices(const DeviceSpec& camera, const DeviceSpec& odometry,
                                                  const RobotFile& robot, linux::MonotonicClock clock, bool wait);

}  // namespace fencepost::host
