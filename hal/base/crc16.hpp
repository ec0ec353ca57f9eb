// CRC-16/CCITT-FALSE: poly 0x1021, init 0xFFFF, no reflection, no final xor. Check value of "123456789": 0x29B1.
#pragma once

#include <cstdint>
#include <string_view>

namespace fencepost::base {

/// Feeds one more byte, all eight bit steps at once: the polynomial has three terms below the leading one, so the bits
/// shifted out at the top are added back in three places, and once more four bits further on.
constexpr std::uint16_t crc16_step(std::uint16_t crc, std::uint8_t byte) {
  unsigned top = (static_cast<unsigned>(crc) >> 8U) ^ byte;
  top ^= top >> 4U;
  return static_cast<std::uint16_t>(((static_cast<unsigned>(crc) << 8U) ^ (top << 12U) ^ (top << 5U) ^ top) & 0xFFFFU);
}

constexpr std::uint16_t crc16(std::string_view text) {
  std::uint16_t crc = 0xFFFF;
  for (const char c : text) crc = crc16_step(crc, static_cast<std::uint8_t>(c));
  return crc;
}

}  // namespace fencepost::base
