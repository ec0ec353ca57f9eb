// What this machine knows of a device beyond its link's state: where it is, and what to try.
#pragma once

#include <string>

#include "hal/sensor/link_state.hpp"
#include "host/live/device_spec.hpp"

namespace fencepost::host {

/// As console::LinkWords, which are views; these own what they say.
struct LinkWording {
  std::string name;    ///< "camera pixy2 at /dev/ttyUSB0"
  std::string device;  ///< "pixy2"; empty: nothing is told of it
  std::string detail;  ///< "/dev/ttyUSB0"
  std::string remedy;
};

/// `problem`: what the port says of its absence; may be empty.
LinkWording word_link(DeviceRole role, const DeviceSpec& spec, sensor::LinkState state, const std::string& problem);

}  // namespace fencepost::host
