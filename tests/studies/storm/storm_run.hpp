// One run: a robot, its devices and its world on one clock, and the faults found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/studies/storm/log_checks.hpp"
#include "tests/studies/storm/plan.hpp"

namespace fencepost::test {

/// A fault of ours, to see that it is found.
enum class Plant : std::uint8_t {
  kNone,
  kLostAlert,    ///< one FPALR does not reach the log
  kLostFrame,    ///< one FPFRM that was used does not
  kBrokenGuard,  ///< something writes behind the robot's memory
  kDeafPin,      ///< the STOP output stays as it is for a second
  kMixedFlash,   ///< a power cut leaves an entry of another value
  kHalfKept,     ///< and one of several settings that were changed together
};

struct RunFigures {
  std::uint64_t turns = 0;
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;
  std::uint64_t power_cuts = 0;
  std::uint64_t log_bytes = 0;
  LogFigures log;
};

struct RunOutcome {
  std::vector<Fault> faults;
  RunFigures figures;
  std::string text;  ///< the log
};

RunOutcome run_storm(const Plan& plan, Plant plant = Plant::kNone);

}  // namespace fencepost::test
