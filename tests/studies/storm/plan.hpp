// Everything that one number decides of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/console/console_state.hpp"
#include "host/live/place.hpp"
#include "tests/studies/storm/events.hpp"
#include "tests/studies/storm/far_end.hpp"
#include "tests/studies/storm/laps.hpp"
#include "tests/studies/storm/robot.hpp"

namespace fencepost::test {

struct Plan {
  std::uint64_t seed = 1;
  std::int64_t milliseconds = 600'000;
  std::size_t variant = 0;                       ///< of kVariants
  std::string camera;                            ///< as the catalogue names it
  host::PlaceKind link = host::PlaceKind::kTty;  ///< of the camera
  Wires wires;                                   ///< where that is a two-wire bus
  std::uint32_t baud = 0;                        ///< of its serial line; 0: as delivered
  std::string wheels;
  console::Mode mode = console::Mode::kLog;
  Kept configured;
  base::Time clock;          ///< the robot's, when it is switched on
  std::int64_t turn_ms = 1;  ///< the longest turn of the loop
  double console_speed = 0;  ///< bytes a millisecond
  std::vector<host::Scene> laps;
  std::vector<Event> events;

  [[nodiscard]] bool console_is_log() const { return kVariants[variant].journal == 0; }
  /// The writer's thread takes its time, so only some runs have one.
  [[nodiscard]] bool disk() const { return kVariants[variant].journal > 64 * 1024 && seed % 3 == 0; }
};

Plan plan_of(std::uint64_t seed, double minutes);

/// The run in a line.
std::string describe(const Plan& plan);

}  // namespace fencepost::test
