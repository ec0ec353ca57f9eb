// From what the command line names to a camera and an odometry that the loop can poll.
#pragma once

#include <optional>
#include <variant>

#include "hal/linux/clock.hpp"
#include "host/devices/device_spec.hpp"
#include "host/live/device.hpp"
#include "host/live/open_port.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::devices {

/// `clock`: the one that the loop reads. `wait`: a device that is not there is awaited, instead of a failure.
/// errors: DeviceFailure: a sentence that says what, where and what to try.
std::variant<host::Devices, host::DeviceFailure> open_devices(const DeviceSpec& camera, const DeviceSpec& odometry,
                                                              const host::RobotFile& robot, linux::MonotonicClock clock,
                                                              bool wait);

/// Resolution, field of view and latency as the camera's maker says them; empty for the console.
std::optional<sensor::CameraIntrinsics> profile_of(const DeviceSpec& camera);

/// The same of a row with its options as delivered; empty unless it is a camera.
std::optional<sensor::CameraIntrinsics> nominal_camera(const Row& row);

/// Wording about a device for messages when its link's state changes.
host::DeviceLabel label_of(const DeviceSpec& spec);

}  // namespace fencepost::devices
