// Which images to segment, each with its pose.
#pragma once

#include <string>
#include <vector>

#include "host/segment/poses_table.hpp"

namespace fencepost::host {

struct View {
  std::string path;
  TimedPose pose;  ///< of the robot
};

struct ImageList {
  std::vector<View> views;       ///< in the order of the table, which is that of time
  std::size_t without_pose = 0;  ///< images of the folder that the table does not name
};

/// Files of `folder` that are named like images, sorted.
std::vector<std::string> images_in(const std::string& folder);

/// `sources`: one folder, whose images the table names relative to it, or image files. The table names each file by its
/// path or its file name. errors: SegmentProblem: an image that the table names is missing, an image file without a
/// pose, no image at all
ImageList list_images(const std::vector<std::string>& sources, const PosesTable& table);

}  // namespace fencepost::host
