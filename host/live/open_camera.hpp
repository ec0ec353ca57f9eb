// The cameras that have a driver.
#pragma once

#include <memory>

#include "host/live/brick.hpp"
#include "host/live/device.hpp"
#include "host/live/device_spec.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host {

/// `brick`: of the odometry, if that is one. errors: DeviceFailure
std::unique_ptr<CameraDevice> open_camera(const DeviceSpec& spec, const RobotFile& robot,
                                          const std::shared_ptr<BrickStation>& brick, bool wait);

/// Resolution, field of view and latency as the camera's maker says them; the mount is the robot's.
std::optional<sensor::CameraIntrinsics> profile_of(const DeviceSpec& spec);

}  // namespace fencepost::host
