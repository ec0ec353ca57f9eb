// A clock that stands still until the test moves it.
#pragma once

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::fake {

class SteppedClock {
 public:
  constexpr explicit SteppedClock(base::Time start = {}) : now_(start) {}
  [[nodiscard]] constexpr base::Time now() const { return now_; }
  constexpr void advance(base::Duration by) { now_ = now_ + by; }

 private:
  base::Time now_;
};

static_assert(bus::Clock<SteppedClock>);

}  // namespace fencepost::fake
