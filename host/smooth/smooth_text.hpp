// Smoothing's results, for a terminal and as JSON.
#pragma once

#include <string>

#include "host/smooth/smooth.hpp"

namespace fencepost::host {

/// Objects, the path's end, and the par.
std::string smooth_text(const Smoothed& smoothed, const std::string& log_name);

/// The result document of the optimum, with `path`, `smooth` and `par`. One line.
std::string smooth_json(const Smoothed& smoothed);

}  // namespace fencepost::host
