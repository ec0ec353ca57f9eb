// Thins a long run to as much as a picture of it can show.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/result/result.hpp"
#include "host/result/to_json.hpp"

namespace fencepost::host {

/// The first and last pose, and those needed in between. An even, straight drive from one to the next is never farther
/// than `tolerance` (m) from the robot's place at that time. Nor is it turned by more than 0.02 rad. Costs n log n.
std::vector<PoseResult> thin_path(const std::vector<PoseResult>& path, double tolerance);

/// The same within 1/4096 of the drive's extent, or as much more as it takes for `most` of them (2 at least).
std::vector<PoseResult> thin_path_to(const std::vector<PoseResult>& path, std::size_t most);

struct ThinnedAlerts {
  std::vector<record::AlertReport> kept;  ///< in order of time
  std::uint64_t all = 0;
  std::uint64_t stops = 0;  ///< of all
};

/// All, if they are no more than `most` (16 at least). Else one object's alerts are thinned where they follow each
/// other faster than a timeline could show. There the worst (of several the nearest) and the last are kept, and always
/// the nearest of them all. In memory that does not grow with their number; `each` is called several times.
ThinnedAlerts thin_alerts(const EachAlert& each, std::size_t most);

}  // namespace fencepost::host
