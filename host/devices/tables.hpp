// The catalogue for people: --help and share/doc/devices.md.
#pragma once

#include <string>

#include "host/devices/device_spec.hpp"

namespace fencepost::devices {

/// What --help says of the devices of a use: names, places, options.
std::string help_for(Use use);

/// The whole of share/doc/devices.md.
std::string devices_document();

}  // namespace fencepost::devices
