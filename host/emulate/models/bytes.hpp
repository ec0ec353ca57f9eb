// Bytes on a cable.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fencepost::emulate {

using Bytes = std::vector<std::uint8_t>;

inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Low byte first.
inline void put(Bytes& bytes, unsigned word) {
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(word >> 8U & 0xFFU));
}

/// The checksum of both HuskyLens.
inline std::uint8_t sum(std::span<const std::uint8_t> bytes) {
  unsigned total = 0;
  for (const std::uint8_t byte : bytes) total += byte;
  return static_cast<std::uint8_t>(total & 0xFFU);
}

}  // namespace fencepost::emulate
