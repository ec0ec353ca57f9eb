// From what the command line names to a device that `fencepost emulate` plays.
#pragma once

#include "host/devices/device_spec.hpp"
#include "host/emulate/models/wheel_adapters.hpp"
#include "host/emulate/scene/endpoint.hpp"
#include "host/emulate/transport/transport.hpp"

namespace fencepost::devices {

/// Borrows nothing. `spec` is for Use::kEmulated, as for all here.
emulate::EmulatedDevice emulated(const DeviceSpec& spec);

/// As it is called in messages.
std::string label_of_emulated(const DeviceSpec& spec);

/// Zeros where nothing counts.
emulate::WheelShape wheels_of(const DeviceSpec& spec);

/// errors: no such place, or it is taken
emulate::OpenedTransport open_transport(const DeviceSpec& spec);

}  // namespace fencepost::devices
