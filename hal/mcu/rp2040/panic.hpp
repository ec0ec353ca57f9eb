// A fault stores what happened in the watchdog's words and has it reset the part. The next run tells.
#pragma once

#include <optional>

#include "hal/mcu/reset.hpp"

namespace fencepost::mcu::rp2040 {

/// What the last run died of, once.
std::optional<Panic> take_panic();

}  // namespace fencepost::mcu::rp2040
