// What goes over a cable.
#pragma once

#include <cstdint>
#include <vector>

namespace fencepost::emulate {

using Bytes = std::vector<std::uint8_t>;

}  // namespace fencepost::emulate
