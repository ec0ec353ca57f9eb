// A driver on a good cable whose device falls silent, is unplugged, switched off, or not there.
#pragma once

#include <cstdint>
#include <optional>

#include "tests/drivers/bench/hostile_cases.hpp"

namespace fencepost::test {

/// The link's state in the phases of a day without damage: a stall, an unplug and a power cycle.
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
Comeback spend_day(const HostileCase& driver);

/// The longest times from the end of a silence to the first sample that says what the device says then.
struct Recovery {
  base::Duration stall;     ///< the line carried nothing, the device went on
  base::Duration unplug;    ///< the plug was out, the device went on
  base::Duration power;     ///< the device was switched off and on; its own start is in it
  std::uint64_t wrong = 0;  ///< samples that say what never was
  std::uint64_t stale = 0;  ///< samples after a power cycle that say what was before it
};
Recovery measure_recovery(const HostileCase& driver);

/// Of a line that carries nothing but noise: a wrong baud rate, a loose ground, another device.
struct Noise {
  std::uint64_t polls = 0;
  std::uint64_t bytes = 0;
  std::uint64_t samples = 0;
  std::uint64_t working = 0;  ///< polls after which the link was said to work
};
/// Two minutes of random bytes, as fast as the line is; the device is off. Nothing where a cable carries no single
/// bytes.
std::optional<Noise> hear_noise(const HostileCase& driver);

}  // namespace fencepost::test
