// The wheel bases that have a driver.
#pragma once

#include <memory>

#include "hal/linux/clock.hpp"
#include "host/live/brick.hpp"
#include "host/live/device.hpp"
#include "host/live/device_spec.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host {

/// `brick`: where `spec` is one, from open_brick. errors: DeviceFailure
std::unique_ptr<OdometryDevice> open_odometry(const DeviceSpec& spec, const RobotFile& robot,
                                              const std::shared_ptr<BrickStation>& brick, linux::MonotonicClock clock,
                                              bool wait);

/// The brick of an odometry `nxt`; nothing for others. errors: DeviceFailure
std::shared_ptr<BrickStation> open_brick(const DeviceSpec& spec, bool wait);

}  // namespace fencepost::host
