// Monotonic time of a board.
#pragma once

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::port {

/// Fill in: a timer that never goes back, converted to counts of 0.1 ms. It never wraps: 64 bits, or a 32-bit counter
/// and its overflows read together. It starts at zero and need not tell the time of day.
class BoardClock {
 public:
  [[nodiscard]] base::Time now() const { return {}; }
};

static_assert(bus::Clock<BoardClock>);

}  // namespace fencepost::port
