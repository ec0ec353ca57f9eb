// Whether the supply is high enough: 168 MHz and flash written by words need 2.7 V (datasheet, operating conditions).
// The part's own reset at a low supply is off as it is delivered.
#pragma once

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// Once, after the clocks.
inline void watch_supply() {
  enable_clock(kRccApb1Enable, kPowerClock);
  set_bits(kPowerControl, kSupplyAbove2V7 | kWatchSupply);
}
inline bool supply_low() { return (reg(kPowerStatus) & kSupplyBelow) != 0; }

}  // namespace fencepost::mcu::stm32f4
