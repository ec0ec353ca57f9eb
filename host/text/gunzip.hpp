// Files that gzip packed.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fencepost::host {

bool is_gzip(std::string_view bytes);

/// What was packed, of all members behind each other. Nothing: damaged, or cut off.
std::optional<std::string> gunzip(std::string_view bytes);

}  // namespace fencepost::host
