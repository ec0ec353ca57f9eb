// Reads the output of the example programs in the Arduino libraries of Pixy2, Pixy, HuskyLens and CMUcams.
#pragma once

#include <string>
#include <string_view>

#include "host/import/take.hpp"

namespace fencepost::host {

/// Frames by their first lines ("Detected 2", "###########", a T packet). Lines of no known form are skipped and
/// counted.
ImportResult import_sketch(std::string_view text, const std::string& file, const TakeSettings& settings);

}  // namespace fencepost::host
