// Drives of KITTI's tracking data set through the product: cars found, poses, STOPs, and what moved and stayed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fencepost::test {

struct KittiConfigured {
  std::optional<double> pitch;  ///< rad, configured; empty: unknown
  bool identity = true;         ///< a signature for each car
  bool detector = false;        ///< a detector's boxes in place of the labelled ones
  bool ids = false;             ///< the labels' tracks are ids of a camera that tracks
};

/// Totals of all drives; lengths are those of the world.
struct KittiScore {
  std::size_t drives = 0;
  std::uint64_t found = 0;
  std::uint64_t missed = 0;
  std::uint64_t phantoms = 0;
  std::uint64_t moving = 0;       ///< of the phantoms, those of tracks that are no parked car; identity only
  std::vector<double> end_error;  ///< m, one a drive: from the last pose of the log
  std::vector<double> recklessness;
  std::vector<double> paranoia;
  double seconds = 0;
  std::size_t stops = 0;
  std::size_t empty_stops = 0;  ///< with nothing labelled in the way
};

/// Names of the drives in `folder`, sorted.
std::vector<std::string> kitti_drives(const std::string& folder);

/// Throws std::runtime_error if a drive cannot be read.
KittiScore run_kitti(const std::vector<std::string>& drives, const KittiConfigured& configured,
                     const std::vector<std::pair<std::string, std::string>>& settings);

}  // namespace fencepost::test
