// Help on the program as a whole.
#pragma once

#include <string>

namespace fencepost::host::cli {

/// The text of `fencepost --help`.
std::string overview();

}  // namespace fencepost::host::cli
