// The last two sectors of the board's flash, for settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/flash_pages.hpp"

namespace fencepost::mcu::rp2 {

/// Of 2 MB, which the linker script leaves free. By the boot ROM's functions (2.8.3.1.3), from memory. Interrupts are
/// held, since the flash cannot be read meanwhile. A call takes 0.4 to 3 ms a page, an erasure up to 0.4 s (W25Q16JV,
/// 9.6). A serial line overruns its 32 bytes in 2.8 ms at 115200 baud; encoders lose counts in an erasure, too.
class Flash {
 public:
  static constexpr std::uint32_t kAddress = 0x1000'0000 + 2U * 1024 * 1024 - 2 * 4096;  ///< of the first

  [[nodiscard]] static constexpr std::size_t size() { return kSector; }
  [[nodiscard]] static std::span<const std::uint8_t> page(std::size_t n);
  static bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes);
  static bool erase(std::size_t n);

 private:
  static constexpr std::size_t kSector = 4096;
};

static_assert(bus::FlashPages<Flash>);

}  // namespace fencepost::mcu::rp2
