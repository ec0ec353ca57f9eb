// A fault stores what happened in memory that start-up leaves alone, and resets the part. The next run tells.
#pragma once

#include <optional>

#include "hal/mcu/reset.hpp"

namespace fencepost::mcu::cortex_m {

/// What the last run died of, once.
std::optional<Panic> take_panic();

}  // namespace fencepost::mcu::cortex_m
