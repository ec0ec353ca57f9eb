// The parts of the page that never change.
#pragma once

#include <string_view>

namespace fencepost::host {

extern const std::string_view kStylesheet;

/// Shows map coordinates under the pointer. Without it nothing is missing but that.
extern const std::string_view kPointerScript;

}  // namespace fencepost::host
