// Functions of the boot ROM, by their two-letter codes (RP2040 datasheet 2.8.3).
#pragma once

#include <cstdint>

#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::mcu::rp2040 {

constexpr std::uint32_t rom_code(char first, char second) {
  return static_cast<std::uint32_t>(first) | (static_cast<std::uint32_t>(second) << 8);
}

/// The ROM begins at address 0, where the compiler would not have anything be.
inline std::uint32_t rom_word(std::uint32_t address) {
  asm("" : "+r"(address));
  return reg(address);
}

/// There is the ROM of this part; an emulator may have none.
inline bool rom_there() { return (rom_word(kRomMagic) & 0xFF'FFFF) == 0x01'754D; }

/// Null if it has no such function. The ROM's own addresses are 16 bits wide; the last one says Thumb.
template <class Function>
Function* rom_function(std::uint32_t code) {
  if (!rom_there()) return nullptr;
  const auto half = [](std::uint32_t address) { return (rom_word(address & ~3U) >> (8 * (address & 2U))) & 0xFFFFU; };
  using LookUp = std::uintptr_t(std::uint32_t table, std::uint32_t code);
  auto* const look_up = reinterpret_cast<LookUp*>(static_cast<std::uintptr_t>(half(kRomLookUp)));
  return reinterpret_cast<Function*>(look_up(half(kRomFunctionTable), code));
}

/// Resets the part into the ROM's USB drive (RP2040 datasheet 2.8.3.1.4). Returns only where there is no ROM.
[[gnu::noinline]] inline void start_boot_loader() {
  using Start = void(std::uint32_t light_pins, std::uint32_t interfaces_off);
  if (Start* const start = rom_function<Start>(rom_code('U', 'B')); start != nullptr) start(0, 0);
}

}  // namespace fencepost::mcu::rp2040
