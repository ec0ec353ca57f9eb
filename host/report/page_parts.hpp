// The constant parts of the page.
#pragma once

#include <string_view>

namespace fencepost::host {

extern const std::string_view kStylesheet;

}  // namespace fencepost::host
