// CRC-16/CCITT-FALSE: poly 0x1021, init 0xFFFF, no reflection, no final xor. Check value of "123456789": 0x29B1.
#pragma once

#include <cstdint>
#include <string_view>

namespace fencepost::base {

/// Feeds one more byte. Bitwise: 16 table-free bytes of code matter more than cycles on the smallest part.
constexpr std::uint16_t crc16_step(std::uint16_t crc, std::uint8_t byte) {
  unsigned value = static_cast<unsigned>(crc) ^ (static_cast<unsigned>(byte) << 8U);
  for (int bit = 0; bit < 8; ++bit) {
    value = (value & 0x8000U) != 0 ? (value << 1U) ^ 0x1021U : value << 1U;
  }
  return static_cast<std::uint16_t>(value & 0xFFFFU);
}

constexpr std::uint16_t crc16(std::string_view text) {
  std::uint16_t crc = 0xFFFF;
  for (const char c : text) crc = crc16_step(crc, static_cast<std::uint8_t>(c));
  return crc;
}

}  // namespace fencepost::base
