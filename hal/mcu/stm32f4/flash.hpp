// Two sectors of the part's own flash, for settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/flash_pages.hpp"

namespace fencepost::mcu::stm32f4 {

/// Sectors 1 and 2, 16 KB each (RM0090 table 5): the linker script leaves them free. The part cannot read its flash
/// while it erases or programs. So the loop stops for up to 0.5 s, or 0.1 ms a word (datasheet, flash characteristics),
/// and serial lines may overrun.
class Flash {
 public:
  static constexpr std::uint32_t kAddress = 0x0800'4000;  ///< of the first

  [[nodiscard]] static constexpr std::size_t size() { return kSize; }
  [[nodiscard]] static std::span<const std::uint8_t> page(std::size_t n);
  static bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes);
  static bool erase(std::size_t n);

 private:
  static constexpr std::size_t kSize = 16 * 1024;
};

static_assert(bus::FlashPages<Flash>);

}  // namespace fencepost::mcu::stm32f4
