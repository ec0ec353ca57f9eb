// `fencepost import` of sources that have blobs and poses but no calibration: csv, sketch, player, candump, mcap.
#pragma once

#include <string>
#include <vector>

#include "host/cli/command.hpp"
#include "host/import/import.hpp"

namespace fencepost::host::cli {

std::vector<Command> take_commands();

/// Writes the log and says what was in the source. errors: Failure
Exit finish_import(const ImportResult& imported, const std::string& output);

}  // namespace fencepost::host::cli
