// The constant parts of the page.
#pragma once

#include <string_view>

namespace fencepost::host {

extern const std::string_view kStylesheet;

/// Shows map coordinates under the pointer; the page works without it.
extern const std::string_view kPointerScript;

}  // namespace fencepost::host
