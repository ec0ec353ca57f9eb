// One register of a part, by its address.
#pragma once

#include <cstdint>

namespace fencepost::mcu {

/// The register at an address that the part's manual gives.
inline volatile std::uint32_t& reg(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(static_cast<std::uintptr_t>(address));
}

/// Likewise, of 16 bits, on parts whose registers are as wide as that.
inline volatile std::uint16_t& reg16(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint16_t*>(static_cast<std::uintptr_t>(address));
}
/// Of 8 bits: memories on a bus of that width.
inline volatile std::uint8_t& reg8(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(static_cast<std::uintptr_t>(address));
}

inline void set_bits(std::uint32_t address, std::uint32_t bits) { reg(address) = reg(address) | bits; }
inline void clear_bits(std::uint32_t address, std::uint32_t bits) { reg(address) = reg(address) & ~bits; }
/// The bits of `mask` become those of `value`.
inline void change_bits(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  reg(address) = (reg(address) & ~mask) | value;
}

/// Polls until the bits of `mask` are those of `value`, at most so many times; false if they never were. No wait is
/// unbounded: emulators leave registers out, crystals fail.
inline bool await_mask(std::uint32_t address, std::uint32_t mask, std::uint32_t value, std::uint32_t looks) {
  for (; looks > 0; --looks) {
    if ((reg(address) & mask) == value) return true;
  }
  return false;
}
/// Until all of `bits` are set.
inline bool await_bits(std::uint32_t address, std::uint32_t bits, std::uint32_t looks) {
  return await_mask(address, bits, bits, looks);
}

}  // namespace fencepost::mcu
