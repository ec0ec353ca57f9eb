// The rules for the log that a robot wrote.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/studies/storm/watch.hpp"

namespace fencepost::test {

/// How the run ended.
struct Ended {
  std::uint64_t digest = 0;
  std::uint32_t frames = 0;      ///< that all robots used
  std::uint32_t in_the_map = 0;  ///< of them, those of the last run that found their odometry: a log without is refused
  std::uint64_t dropped = 0;     ///< records that they said they dropped
  bool whole = true;             ///< the log has all of it: no disk was full
  bool alerts_off = false;       ///< somebody silenced the alerts for a while
  base::Duration longest_turn;   ///< of the loop, whatever kept it
  bool choked = false;           ///< the log was slower than meant at any time
  config::Settings settings;
};

struct LogFigures {
  std::uint64_t compared = 0;
  std::uint64_t alerts = 0;
  std::uint64_t stops = 0;
  std::uint64_t blind = 0;
};

LogFigures check_log(std::string_view log, const Ended& ended, std::vector<Fault>& faults);

}  // namespace fencepost::test
