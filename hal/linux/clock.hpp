// The machine's monotonic clock, from zero.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/bus/clock.hpp"

namespace fencepost::linux {

/// Zero is the moment of construction; copies share it. Stands still while the machine is suspended (CLOCK_MONOTONIC).
class MonotonicClock {
 public:
  MonotonicClock();
  [[nodiscard]] base::Time now() const;

 private:
  std::int64_t zero_ns_;
};

static_assert(bus::Clock<MonotonicClock>);

}  // namespace fencepost::linux
