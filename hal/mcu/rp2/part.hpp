// Which of the two parts a program is for: an RP2350 where FENCEPOST_RP2350 is defined, else an RP2040.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/registers.hpp"
#if defined(FENCEPOST_RP2350)
#include "hal/mcu/rp2350/registers.hpp"
#include "hal/mcu/rp2350/rom.hpp"
#include "hal/mcu/rp2350/ticks.hpp"
#else
#include "hal/mcu/rp2040/registers.hpp"
#include "hal/mcu/rp2040/rom.hpp"
#include "hal/mcu/rp2040/ticks.hpp"
#endif

namespace fencepost::mcu::rp2 {

#if defined(FENCEPOST_RP2350)
using namespace rp2350;
#else
using namespace rp2040;
#endif

/// A peripheral comes out of reset; bounded, it takes some cycles.
inline void bring_up(std::uint32_t peripherals) {
  raise_bits(kResets, peripherals);
  lower_bits(kResets, peripherals);
  static_cast<void>(await_bits(kResetsDone, peripherals, 10'000));
}

}  // namespace fencepost::mcu::rp2
