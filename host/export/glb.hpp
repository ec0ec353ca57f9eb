// A run's objects as solids in a binary glTF 2.0 file, for any viewer of 3-D models.
#pragma once

#include <string>

#include "host/export/run.hpp"

namespace fencepost::host::exports {

/// Outlines extruded to their heights, one node an object with its numbers as extras, and the robot's path as a line.
/// m; the file's y is up, as glTF has it, our z.
std::string glb_of(const Run& run, const std::string& model);

}  // namespace fencepost::host::exports
