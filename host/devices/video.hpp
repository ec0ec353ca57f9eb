// Settings of cameras that deliver pictures, for `fencepost train`.
#pragma once

#include "hal/linux/v4l2.hpp"
#include "host/devices/device_spec.hpp"

namespace fencepost::devices {

/// Settings of a `v4l2`. errors: host::DeviceFailure: this build cannot read the requested format
linux::V4l2Settings webcam_settings(const DeviceSpec& spec);

}  // namespace fencepost::devices
