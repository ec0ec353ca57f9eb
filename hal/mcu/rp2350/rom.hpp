// Functions of the boot ROM, by their two-letter codes (RP2350 datasheet 5.4).
#pragma once

#include <cstdint>

#include "hal/mcu/rp2/rom_word.hpp"
#include "hal/mcu/rp2350/registers.hpp"

namespace fencepost::mcu::rp2350 {

/// There is the ROM of this part; an emulator may have none.
inline bool rom_there() { return (rp2::rom_word(kRomMagic) & 0xFF'FFFF) == 0x02'754D; }

/// Where a function is; 0 if the ROM has none.
[[gnu::noinline]] inline std::uintptr_t rom_address(std::uint32_t code) {
  if (!rom_there()) return 0;
  using LookUp = std::uintptr_t(std::uint32_t code, std::uint32_t kind);
  auto* const look_up = reinterpret_cast<LookUp*>(static_cast<std::uintptr_t>(rp2::rom_half(kRomLookUp)));
  return look_up(code, kRomSecureFunction);
}
/// Null if it has no such function.
template <class Function>
Function* rom_function(std::uint32_t code) {
  return reinterpret_cast<Function*>(rom_address(code));
}

/// Resets the part into the ROM's USB drive (5.4.8.24). Returns only where there is no ROM.
[[gnu::noinline]] inline void start_boot_loader() {
  constexpr std::uint32_t kSoon = 10;  // ms
  using Reboot = int(std::uint32_t how, std::uint32_t delay, std::uint32_t first, std::uint32_t second);
  if (Reboot* const reboot = rom_function<Reboot>(rp2::rom_code('R', 'B')); reboot != nullptr)
    reboot(kRomToLoader | kRomNoReturn, kSoon, 0, 0);
}

}  // namespace fencepost::mcu::rp2350
