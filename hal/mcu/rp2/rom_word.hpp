// Words of the boot ROM.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"

namespace fencepost::mcu::rp2 {

/// Of a function of the ROM: its two letters.
constexpr std::uint32_t rom_code(char first, char second) {
  return static_cast<std::uint32_t>(first) | (static_cast<std::uint32_t>(second) << 8);
}

/// The ROM begins at address 0, where the compiler would not have anything be.
inline std::uint32_t rom_word(std::uint32_t address) {
  asm("" : "+r"(address));
  return reg(address);
}
/// The ROM's own addresses are 16 bits wide; the last one says Thumb.
inline std::uint32_t rom_half(std::uint32_t address) {
  return (rom_word(address & ~3U) >> (8 * (address & 2U))) & 0xFFFFU;
}

}  // namespace fencepost::mcu::rp2
