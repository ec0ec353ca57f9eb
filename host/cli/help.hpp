// Help on the program as a whole.
#pragma once

#include <string>

namespace fencepost::host::cli {

/// What `fencepost --help` prints.
std::string overview();

}  // namespace fencepost::host::cli
