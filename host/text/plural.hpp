// Counts in words.
#pragma once

#include <cstdint>
#include <string>

namespace fencepost::host {

/// "1 frame", "2 frames".
inline std::string plural(std::uint64_t count, const char* noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

}  // namespace fencepost::host
