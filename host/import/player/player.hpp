// Logs of Player's driver writelog (playerstage.sourceforge.net, versions 1.6 to 3.0): position2d and blobfinder.
#pragma once

#include <string>
#include <string_view>

#include "host/import/take.hpp"

namespace fencepost::host {

/// Lines "time host robot interface index type subtype ...". Of several position2d, the one of index 0, or the first.
/// Signature: the blob's id, or where all ids are 0 its colour's number.
ImportResult import_player(std::string_view text, const std::string& file, const TakeSettings& settings);

}  // namespace fencepost::host
