// All drivers that run through hostile hours.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/sensor/link_state.hpp"
#include "tests/drivers/bench/hostile_figures.hpp"

namespace fencepost::test {

/// The link's state in the phases of a day without damage.
struct Comeback {
  sensor::LinkState before = sensor::LinkState::kOk;  ///< while the device is dead, at the beginning
  sensor::LinkState working = sensor::LinkState::kAbsent;
  sensor::LinkState stalled = sensor::LinkState::kOk;  ///< long enough
  sensor::LinkState after_stall = sensor::LinkState::kAbsent;
  sensor::LinkState unplugged = sensor::LinkState::kOk;
  sensor::LinkState replugged = sensor::LinkState::kAbsent;
  sensor::LinkState after_power_cycle = sensor::LinkState::kAbsent;
  std::uint64_t samples_after_power_cycle = 0;
  std::uint64_t wrong = 0;  ///< samples, ever
};

/// The longest times from the end of a silence to the first sample that says what the device says then.
struct Recovery {
  base::Duration stall;   ///< the line carried nothing, the device went on
  base::Duration unplug;  ///< the plug was out, the device went on
  base::Duration power;   ///< the device was switched off and on; its own start is in it
};

/// What a driver made of noise alone.
struct Noise {
  std::uint64_t polls = 0;
  std::uint64_t bytes = 0;
  std::uint64_t samples = 0;
  std::uint64_t working = 0;  ///< polls after which the link was said to work
};

struct HostileCase {
  std::string_view name;  ///< as devices are named on command lines, with what is behind the colon
  HostileFigures (*hours)(double hours, std::uint32_t seed);
  Comeback (*comeback)();
  Recovery (*recovery)();
  std::optional<Noise> (*noise)();
  HostileLimits limits;
};

std::span<const HostileCase> hostile_cases();

}  // namespace fencepost::test
