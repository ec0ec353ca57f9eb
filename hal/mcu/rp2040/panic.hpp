// A fault is stored in the watchdog's scratch words, and the watchdog resets the part. The next run reports it.
#pragma once

#include <optional>

#include "hal/mcu/reset.hpp"

namespace fencepost::mcu::rp2040 {

/// The fault that ended the last run; reading clears it.
std::optional<Panic> take_panic();

}  // namespace fencepost::mcu::rp2040
