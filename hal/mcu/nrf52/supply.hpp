// Whether the supply has been high enough. The part works down to 1.8 V, and its own reset holds it below 1.7 V; a
// motor driver of 3.3 V does not. With this watch on it also refuses to write flash while the supply is low.
#pragma once

#include "hal/mcu/nrf52/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf52 {

/// For 2.1 V. Once, after the start.
inline void watch_supply() {
  reg(kSupplyWatch) = kWatchSupply | kSupplyAbove2V1;
  reg(kSupplyFell) = 0;
}
/// It has fallen below since. The part tells of the fall alone, not of the rise: so this holds until the next reset.
inline bool supply_low() { return reg(kSupplyFell) != 0; }

}  // namespace fencepost::mcu::nrf52
