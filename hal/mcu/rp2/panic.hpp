// A fault is stored in the watchdog's scratch words, and the watchdog resets the part. The next run reports it.
#pragma once

#include <optional>

#include "hal/mcu/reset.hpp"

namespace fencepost::mcu::rp2 {

/// The fault that ended the last run; reading clears it.
std::optional<Panic> take_panic();

extern "C" {
/// A board defines it: called before anything else when a run ends in a fault. Its motors are held, whatever becomes of
/// the part.
void fencepost_hold_motors();
}

}  // namespace fencepost::mcu::rp2
