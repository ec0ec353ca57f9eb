// The state of the two sensors' cables.
#pragma once

#include "hal/sensor/link_state.hpp"

namespace fencepost::console {

struct Links {
  sensor::LinkState camera = sensor::LinkState::kAbsent;
  sensor::LinkState odometry = sensor::LinkState::kAbsent;
};

}  // namespace fencepost::console
