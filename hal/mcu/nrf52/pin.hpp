// A pin, and what it is set up as.
#pragma once

#include "hal/mcu/nrf51/pin.hpp"

namespace fencepost::mcu::nrf52 {

/// P0.00 to P0.31, and P1.00 to P1.09 as 32 to 41.
using Pin = nrf51::PinOf<2>;

}  // namespace fencepost::mcu::nrf52
