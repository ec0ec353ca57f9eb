// Poses of images in any of the forms that people have them in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/sensor/camera.hpp"
#include "host/segment/floor.hpp"
#include "host/segment/poses_table.hpp"

namespace fencepost::host {

/// A table (poses_table.hpp), COLMAP's images.txt, or TUM's trajectory. TUM's poses belong to those of `images` whose
/// name is a time (s, or ns), at most 0.2 s from a pose on each side. errors: SegmentProblem with file and line
PosesTable read_poses(std::string_view text, const std::string& file, const std::vector<std::string>& images,
                      const sensor::CameraMount& mount, const FloorOptions& options);

}  // namespace fencepost::host
