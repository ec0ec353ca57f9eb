// Wording for a device that its link's state does not have: its name, its place, and what to try.
#pragma once

#include <string>

#include "hal/sensor/link_state.hpp"

namespace fencepost::host {

/// Who a device is and where, and what to try when it does not work.
struct DeviceLabel {
  std::string name;     ///< "camera pixy2 at /dev/ttyUSB0"
  std::string device;   ///< "pixy2"
  std::string detail;   ///< "/dev/ttyUSB0"
  std::string silent;   ///< things to check where nothing answers
  std::string unready;  ///< why it may answer and not work
};

/// As console::LinkWords, which are views; these own what they say.
struct LinkWording {
  std::string name;    ///< "camera pixy2 at /dev/ttyUSB0"
  std::string device;  ///< "pixy2"; empty: no words about it
  std::string detail;  ///< "/dev/ttyUSB0"
  std::string remedy;
};

/// `problem`: what the port says of its absence; may be empty.
LinkWording word_link(const DeviceLabel& label, sensor::LinkState state, const std::string& problem);

}  // namespace fencepost::host
