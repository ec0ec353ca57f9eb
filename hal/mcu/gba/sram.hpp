// The cartridge's memory with a battery, for settings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/flash_pages.hpp"

namespace fencepost::mcu::gba {

/// Two pages in the first half of 32 KB. The bus has 8 bits and gives one byte twice to a wider read, so pages are read
/// from a copy. A cartridge without such memory holds nothing: program() and erase() then answer false.
class Sram {
 public:
  /// Takes the copy. Called once, before anything else here.
  void start();

  static constexpr std::uint32_t kAddress = 0x0E00'0000;  ///< of the first (GBATEK, Cart Backup SRAM/FRAM)

  [[nodiscard]] static constexpr std::size_t size() { return kSize; }
  [[nodiscard]] std::span<const std::uint8_t> page(std::size_t n) const { return copy_[n]; }
  bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes);
  bool erase(std::size_t n);

 private:
  static constexpr std::size_t kSize = 8 * 1024;

  [[nodiscard]] bool write(std::size_t n, std::size_t offset, std::uint8_t byte);

  std::array<std::array<std::uint8_t, kSize>, 2> copy_{};
};

static_assert(bus::FlashPages<Sram>);

}  // namespace fencepost::mcu::gba
