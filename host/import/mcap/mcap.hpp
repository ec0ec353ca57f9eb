// Detections and odometry of a ROS 2 recording in MCAP: any detector becomes a camera.
#pragma once

#include <string>
#include <string_view>

#include "host/import/take.hpp"

namespace fencepost::host {

struct McapTopics {
  std::string detections;  ///< empty: the only topic of that schema
  std::string odometry;
};

/// vision_msgs/msg/Detection2DArray (of 4.x) and nav_msgs/msg/Odometry, as CDR or as JSON of the same fields. The class
/// with the best score is the colour; classes are numbered in order of their first appearance.
ImportResult import_mcap(std::string_view bytes, const std::string& file, const McapTopics& topics,
                         const TakeSettings& settings);

}  // namespace fencepost::host
