// An image as `fencepost configure` makes it on a desk.
#pragma once

#include <string>

#include "host/configure/configure.hpp"

namespace fencepost::test {

/// Configures the board's image file, which ends with `ending` (".uf2"), and writes it beside it. Its path without the
/// ending. Throws std::runtime_error with the reason.
std::string configured_image(const std::string& board, const std::string& ending,
                             const host::ConfigureRequest& request);

}  // namespace fencepost::test
