// Functions of the boot ROM, by their two-letter codes (RP2040 datasheet 2.8.3).
#pragma once

#include <cstdint>

#include "hal/mcu/rp2/rom_word.hpp"
#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::mcu::rp2040 {

/// There is the ROM of this part; an emulator may have none.
inline bool rom_there() { return (rp2::rom_word(kRomMagic) & 0xFF'FFFF) == 0x01'754D; }

/// Where a function is; 0 if the ROM has none.
[[gnu::noinline]] inline std::uintptr_t rom_address(std::uint32_t code) {
  if (!rom_there()) return 0;
  using LookUp = std::uintptr_t(std::uint32_t table, std::uint32_t code);
  auto* const look_up = reinterpret_cast<LookUp*>(static_cast<std::uintptr_t>(rp2::rom_half(kRomLookUp)));
  return look_up(rp2::rom_half(kRomFunctionTable), code);
}
/// Null if it has no such function.
template <class Function>
Function* rom_function(std::uint32_t code) {
  return reinterpret_cast<Function*>(rom_address(code));
}

/// Resets the part into the ROM's USB drive (RP2040 datasheet 2.8.3.1.4). Returns only where there is no ROM.
[[gnu::noinline]] inline void start_boot_loader() {
  using Start = void(std::uint32_t light_pins, std::uint32_t interfaces_off);
  if (Start* const start = rom_function<Start>(rp2::rom_code('U', 'B')); start != nullptr) start(0, 0);
}

}  // namespace fencepost::mcu::rp2040
