// Whether the supply has been high enough. The parts work down to 1.8 V, and their own reset holds them below 1.7 V; a
// motor driver of 3.3 V does not. With this watch on they also refuse to write flash while the supply is low.
#pragma once

#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {

/// Once, after the start. `above`: the part's value for 2.1 V.
inline void watch_supply(std::uint32_t above) {
  reg(kSupplyWatch) = kWatchSupply | above;
  reg(kSupplyFell) = 0;
}
/// It has fallen below since. The part tells of the fall alone, not of the rise: so this holds until the next reset.
inline bool supply_low() { return reg(kSupplyFell) != 0; }

}  // namespace fencepost::mcu::nrf51
