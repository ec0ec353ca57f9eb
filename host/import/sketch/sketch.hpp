// What the example programs of Pixy2's, Pixy's, the HuskyLens' and CMUcams' Arduino libraries print.
#pragma once

#include <string>
#include <string_view>

#include "host/import/take.hpp"

namespace fencepost::host {

/// Frames by their first lines ("Detected 2", "###########", a T packet). Lines of no known form are skipped and
/// counted. `rate`: of frames without the monitor's times.
Taken take_sketch(std::string_view text, double rate);

ImportResult import_sketch(std::string_view text, const std::string& file, const TakeSettings& settings);

}  // namespace fencepost::host
