// A run as a table of changes, one value a line: AdvantageScope's "list" form, and any spreadsheet's.
#pragma once

#include <string>

#include "host/export/run.hpp"

namespace fencepost::host::exports {

/// Columns Timestamp (s), Key, Value, in order of time. Keys: robot/x, y, heading; camera/blobs; objects/3 red/x, y,
/// radius, views, confidence, state; alerts/level, text, distance, bearing. m, rad, map frame.
std::string csv_of(const Run& run);

}  // namespace fencepost::host::exports
