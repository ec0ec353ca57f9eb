// Pictures as PNG files.
#pragma once

#include <string>

#include "host/render/picture.hpp"

namespace fencepost::host {

/// The bytes of the file; the same picture gives the same bytes (with the same libpng). errors: std::runtime_error with
/// libpng's words.
std::string png(const Picture& picture);

}  // namespace fencepost::host
