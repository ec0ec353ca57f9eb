// Bytes as the protocols' documents print them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost {

/// "41 43 4B" as three bytes.
inline std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 3) {
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

inline std::vector<std::uint8_t> octets(std::string_view bytes) { return {bytes.begin(), bytes.end()}; }

constexpr std::uint8_t octet(char c) { return static_cast<std::uint8_t>(c); }

}  // namespace fencepost
