// What this machine knows of a device beyond its link's state: who and where it is, and what to try.
#pragma once

#include <string>

#include "hal/sensor/link_state.hpp"

namespace fencepost::host {

/// Who a device is and where, and what to try when it does not work.
struct DeviceLabel {
  std::string name;     ///< "camera pixy2 at /dev/ttyUSB0"
  std::string device;   ///< "pixy2"
  std::string detail;   ///< "/dev/ttyUSB0"
  std::string silent;   ///< what to check where nothing answers
  std::string unready;  ///< why it may answer and not work
};

/// As console::LinkWords, which are views; these own what they say.
struct LinkWording {
  std::string name;    ///< "camera pixy2 at /dev/ttyUSB0"
  std::string device;  ///< "pixy2"; empty: nothing is told of it
  std::string detail;  ///< "/dev/ttyUSB0"
  std::string remedy;
};

/// `problem`: what the port says of its absence; may be empty.
LinkWording word_link(const DeviceLabel& label, sensor::LinkState state, const std::string& problem);

}  // namespace fencepost::host
