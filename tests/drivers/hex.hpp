// Bytes as the protocol documents print them.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace fencepost::test {

/// "AF C1 21" to bytes.
inline std::vector<std::uint8_t> hex(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 0; at + 1 < text.size(); at += 3) {
    bytes.push_back(static_cast<std::uint8_t>(std::strtoul(text.substr(at, 2).c_str(), nullptr, 16)));
  }
  return bytes;
}

template <class Range>
std::vector<std::uint8_t> bytes_of(const Range& range) {
  return {range.begin(), range.end()};
}

}  // namespace fencepost::test
