// Two pages of the part's own flash, for settings.
#pragma once

#include "hal/mcu/nrf51/flash.hpp"
#include "hal/mcu/nrf52/registers.hpp"

namespace fencepost::mcu::nrf52 {

/// The last two pages of 512 KB: the linker script leaves them free. While the flash erases (85 ms a page) or writes
/// (41 us a word) the core stops, except for the contents of its cache. So the serial line overruns. Source: NVMC,
/// electrical specification.
using Flash = nrf51::TwoPages<0x0007'E000, kFlashPage>;
static_assert(bus::FlashPages<Flash>);

}  // namespace fencepost::mcu::nrf52
