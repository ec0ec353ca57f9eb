// The map's background: metre grid, axes, the frame's origin, scale bar.
#pragma once

#include <string>

#include "host/report/map_frame.hpp"

namespace fencepost::host {

std::string draw_grid(const MapFrame& frame);

/// Two arrows at the map's origin, where it is in view.
std::string draw_origin(const MapFrame& frame);

std::string draw_scale_bar(const MapFrame& frame);

}  // namespace fencepost::host
