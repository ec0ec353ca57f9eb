// Every device that the program knows.
#pragma once

#include <vector>

#include "host/devices/device_spec.hpp"
#include "host/devices/row.hpp"

namespace fencepost::devices {

/// In the order of help and documents.
const Rows& catalogue();

/// Those that can be named for a use.
std::vector<const Row*> rows_for(Use use);

}  // namespace fencepost::devices
