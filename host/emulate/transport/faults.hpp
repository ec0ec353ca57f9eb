// Faults on purpose: the same for the same seed.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "hal/base/units.hpp"

namespace fencepost::emulate {

/// A zero is a fault that does not happen.
struct FaultSettings {
  double drop = 0;     ///< probability that a byte (CAN: a frame) is lost, either way
  double corrupt = 0;  ///< that it arrives as another one; a CAN controller throws such a frame away
  double stall = 0;    ///< that after something the device said the line carries nothing, either way, for a time
  base::Duration stall_time;
  double late = 0;  ///< that something the device says comes late
  base::Duration late_time;
  base::Duration reboot;  ///< period at which the device is switched off and on
  base::Duration unplug;  ///< period at which the line is hung up for a time
  base::Duration unplug_time;
};

/// "drop=0.01,stall=0.001:2.0,reboot=30"; times in seconds. `problem`: a sentence, empty if all is well.
struct ParsedFaults {
  FaultSettings settings;
  std::string problem;
};
/// `start`: the settings in force, which stay where `text` has none.
ParsedFaults parse_faults(std::string_view text, const FaultSettings& start = {});

struct FaultCounts {
  std::uint64_t bytes = 0;  ///< (CAN: frames) that went over the line, either way, the lost ones included
  std::uint64_t dropped = 0;
  std::uint64_t corrupted = 0;
  std::uint64_t said = 0;  ///< replies, packets, lines
  std::uint64_t stalled = 0;
  std::uint64_t late = 0;
  std::uint64_t reboots = 0;
  std::uint64_t unplugs = 0;
};

/// Dice of one direction, so that its bytes do not change the other direction's draws. Each call draws once for each
/// fault that is on.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  bool chance(double probability);
  /// Any byte but this one.
  std::uint8_t another(std::uint8_t byte);

 private:
  std::mt19937_64 random_;  // its numbers are the same everywhere
};

/// A byte on its way; nothing: lost.
std::optional<std::uint8_t> damaged(std::uint8_t byte, const FaultSettings& faults, Dice& dice, FaultCounts& counts);

}  // namespace fencepost::emulate
