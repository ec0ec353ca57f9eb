// A robot's WPILib data log: targets of PhotonVision or a Limelight, and the poses of its odometry.
#pragma once

#include <string>
#include <string_view>

#include "host/import/take.hpp"

namespace fencepost::host {

struct WpilogTopics {
  std::string detections;  ///< an entry's name; empty: the one that says most
  std::string odometry;
};

/// Boxes, from what says most to what says least: PhotonVision's results, a Limelight's `json`, `rawdetections`,
/// `tcornxy`, and `tx` with `ty`, which are bearings. Poses: struct:Pose2d, struct:Pose3d, or three numbers with
/// degrees, as Field2d has them. share/doc/import.md has what is taken of each.
ImportResult import_wpilog(std::string_view bytes, const std::string& file, const WpilogTopics& topics,
                           const TakeSettings& settings);

}  // namespace fencepost::host
