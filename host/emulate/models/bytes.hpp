// What goes over a cable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fencepost::emulate {

using Bytes = std::vector<std::uint8_t>;

inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

}  // namespace fencepost::emulate
