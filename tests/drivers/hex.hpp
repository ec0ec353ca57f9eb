// Bytes as the protocols' documents print them.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::test {

/// "AF C1 21" as three bytes.
inline std::vector<std::uint8_t> hex(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 0; at + 1 < text.size(); at += 3) {
    bytes.push_back(static_cast<std::uint8_t>(std::strtoul(std::string(text.substr(at, 2)).c_str(), nullptr, 16)));
  }
  return bytes;
}

template <class Range>
std::vector<std::uint8_t> bytes_of(const Range& range) {
  return {range.begin(), range.end()};
}

inline std::vector<std::uint8_t> joined(const std::vector<std::vector<std::uint8_t>>& parts) {
  std::vector<std::uint8_t> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The same for protocols that are mostly text.
inline std::string hex_text(std::string_view text) {
  const std::vector<std::uint8_t> bytes = hex(text);
  return {bytes.begin(), bytes.end()};
}

constexpr std::uint8_t octet(char c) { return static_cast<std::uint8_t>(c); }

}  // namespace fencepost::test
