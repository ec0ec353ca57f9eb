// What makes a case of a rig: for the bench's own list, and for a driver's folder that adds one to it.
#pragma once

#include "tests/drivers/bench/comeback.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/bench/hostile_hours.hpp"
#include "tests/drivers/bench/noise.hpp"
#include "tests/drivers/bench/recovery.hpp"

namespace fencepost::test {

/// The share of undetected damage that a protocol with sums of one byte may have.
inline constexpr double kSum8 = 1e-3;

/// Steps of the loop in milliseconds, as coarse as the device allows.
template <class Rig, std::int64_t Step>
HostileCase hostile_case(std::string_view name, const HostileLimits& limits) {
  return {
      name,
      [](double hours, std::uint32_t seed) { return run_hostile_hours<Rig>(hours, seed, base::milliseconds(Step)); },
      [] { return spend_day<Rig>(base::milliseconds(Step)); },
      [] { return measure_recovery<Rig>(base::milliseconds(Step)); },
      [] { return hear_noise<Rig>(base::milliseconds(Step)); },
      limits};
}

/// Adds a case, before `main`. Its source belongs to fencepost_hostile.
struct RegisteredCase {
  explicit RegisteredCase(const HostileCase& hostile_case);
};

}  // namespace fencepost::test
