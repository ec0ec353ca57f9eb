// Figures of hostile hours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/base/units.hpp"

namespace fencepost::test {

struct HostileFigures {
  double hours = 0;
  std::uint64_t samples = 0;            ///< frames or poses that the driver gave
  std::uint64_t corrupted = 0;          ///< bytes
  std::uint32_t faults = 0;             ///< stalls, reboots, unplugs
  std::uint64_t whole = 0;              ///< frames that the device sent undamaged in calm
  std::uint64_t right_in_calm = 0;      ///< of the samples, those that are what the device said
  std::uint64_t corrupted_in_calm = 0;  ///< bytes
  std::uint64_t undetected = 0;         ///< samples that are not what the device said
  std::uint64_t held_back = 0;          ///< samples some seconds old, after a stall
  std::uint32_t disorder = 0;           ///< samples not later than the one before
  base::Duration longest_gap;           ///< between two samples in calm
  base::Duration longest_recovery;      ///< from a fault's end to the first right sample
  std::size_t longest_queue = 0;        ///< bytes or frames that waited for the driver
  std::uint64_t said = 0;        ///< digest of all samples as records, of the link's states, of what the driver counted
  std::int64_t heap_growth = 0;  ///< bytes of the whole program, from a tenth of the time to the end

  /// Good frames that the driver did not give.
  [[nodiscard]] std::uint64_t lost() const { return whole > right_in_calm ? whole - right_in_calm : 0; }
};

/// A driver's limits.
struct HostileLimits {
  double undetected_share = 0;      ///< of the samples
  std::uint64_t least_samples = 0;  ///< an hour
  base::Duration longest_wait;      ///< gap or recovery: longer, it hangs
  base::Duration own_start = {};    ///< of the device, from power to its first sample
  bool reset_starts_it = false;     ///< and after a silence it has to be reset
  bool sealed_in_parts = false;     ///< nothing tells that a box of a frame is missing
};

/// Violated limits, in words; empty if there are none.
std::vector<std::string> hostile_faults(const HostileFigures& figures, const HostileLimits& limits);

/// Bytes that this program has of the heap; 0 where the C library does not tell.
std::uint64_t heap_in_use();

}  // namespace fencepost::test
