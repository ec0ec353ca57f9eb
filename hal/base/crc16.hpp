// CRC-16/CCITT-FALSE: poly 0x1021, init 0xFFFF, no reflection, no final xor. Check value of "123456789": 0x29B1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fencepost::base {

/// Feeds one more byte, all eight bit steps at once. The polynomial has three terms below the leading one. So the bits
/// shifted out at the top are added back in three places, and once more four bits further on.
constexpr std::uint16_t crc16_step(std::uint16_t crc, std::uint8_t byte) {
  unsigned top = (static_cast<unsigned>(crc) >> 8U) ^ byte;
  top ^= top >> 4U;
  return static_cast<std::uint16_t>(((static_cast<unsigned>(crc) << 8U) ^ (top << 12U) ^ (top << 5U) ^ top) & 0xFFFFU);
}

// A desk has 4 KB for tables, and then eight bytes cost what one does: table k has what a byte does k bytes later.
#if defined(__x86_64__) || defined(__aarch64__)
inline constexpr bool kCrcTables = true;
#else
inline constexpr bool kCrcTables = false;
#endif

inline constexpr auto kCrcOf = [] {
  std::array<std::array<std::uint16_t, 256>, kCrcTables ? 8 : 1> tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    std::uint16_t crc = crc16_step(0, static_cast<std::uint8_t>(byte));
    for (auto& table : tables) {
      table[byte] = crc;
      crc = crc16_step(crc, 0);
    }
  }
  return tables;
}();

constexpr std::uint16_t crc16(std::string_view text) {
  std::uint16_t crc = 0xFFFF;
  if constexpr (kCrcTables) {
    for (; text.size() >= 8; text.remove_prefix(8)) {
      const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(text[at]); };
      unsigned sum = kCrcOf[7][(crc >> 8U) ^ byte(0)];
      sum ^= kCrcOf[6][(crc & 0xFFU) ^ byte(1)];
      for (std::size_t k = 2; k < 8; ++k) sum ^= kCrcOf[7 - k][byte(k)];
      crc = static_cast<std::uint16_t>(sum);
    }
  }
  for (const char c : text) crc = crc16_step(crc, static_cast<std::uint8_t>(c));
  return crc;
}

}  // namespace fencepost::base
