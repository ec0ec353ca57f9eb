#include "hal/mcu/gba/sram.hpp"

#include "hal/mcu/gba/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::gba {
namespace {

// Emulators and flash cartridges look for this word to know the cartridge's kind of memory; at a multiple of four.
// Source: GBATEK, Cart Backup IDs.
[[gnu::used, gnu::aligned(4)]] constexpr char kKind[] = "SRAM_V113";

// While the cartridge's memory is being used, no instruction may be fetched from the cartridge: they share a bus. So
// these two lie in fast memory, and are not inlined.
[[gnu::section(".fast"), gnu::noinline]] std::uint8_t peek(std::uint32_t address) { return reg8(address); }
[[gnu::section(".fast"), gnu::noinline]] std::uint8_t poke(std::uint32_t address, std::uint8_t byte) {
  reg8(address) = byte;
  return reg8(address);
}

std::uint32_t address_of(std::size_t n, std::size_t offset) {
  return Sram::kAddress + static_cast<std::uint32_t>(n * Sram::size() + offset);
}

}  // namespace

void Sram::start() {
  for (std::size_t n = 0; n < copy_.size(); ++n) {
    for (std::size_t i = 0; i < kSize; ++i) copy_[n][i] = peek(address_of(n, i));
  }
}

bool Sram::program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
  bool kept = true;
  for (std::size_t i = 0; i < bytes.size(); ++i) kept = write(n, offset + i, bytes[i]) && kept;
  return kept;
}

bool Sram::erase(std::size_t n) {
  bool kept = true;
  for (std::size_t i = 0; i < kSize; ++i) kept = write(n, i, 0xFF) && kept;
  return kept;
}

bool Sram::write(std::size_t n, std::size_t offset, std::uint8_t byte) {
  copy_[n][offset] = poke(address_of(n, offset), byte);
  return copy_[n][offset] == byte;
}

}  // namespace fencepost::mcu::gba
