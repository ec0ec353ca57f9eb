// Where the robot went.
#pragma once

#include <string>
#include <vector>

#include "host/report/label_space.hpp"
#include "host/report/map_frame.hpp"

namespace fencepost::host {

/// The line, heading ticks along it, times beside it, start and end.
std::string draw_path(const MapFrame& frame, const std::vector<PoseResult>& path, LabelSpace& space);

/// Metres driven.
double path_length(const std::vector<PoseResult>& path);

}  // namespace fencepost::host
