// The layouts of our JSON messages as JSON schemas, for viewers that show fields; they are known by their names.
#pragma once

#include <string>

namespace fencepost::host::exports {

std::string frame_transform_schema();  ///< foxglove.FrameTransform
std::string pose_in_frame_schema();    ///< foxglove.PoseInFrame
std::string scene_update_schema();     ///< foxglove.SceneUpdate
std::string log_schema();              ///< foxglove.Log
std::string odometry_schema();         ///< nav_msgs/msg/Odometry
std::string detections_schema();       ///< vision_msgs/msg/Detection2DArray

}  // namespace fencepost::host::exports
