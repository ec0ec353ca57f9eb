// Counts in words.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fencepost::host {

/// "1 reply", "2 replies".
inline std::string plural(std::uint64_t count, std::string_view one, std::string_view many) {
  return std::to_string(count) + ' ' + std::string(count == 1 ? one : many);
}

/// "1 frame", "2 frames".
inline std::string plural(std::uint64_t count, std::string_view noun) {
  return plural(count, noun, std::string(noun) + 's');
}

}  // namespace fencepost::host
