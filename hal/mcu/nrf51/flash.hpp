// Two pages of the part's own flash, for settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/flash_pages.hpp"

namespace fencepost::mcu::nrf51 {

/// The last two pages of 256 KB: the linker script leaves them free. The core stands still while the flash erases
/// (23 ms a page) or writes (46 us a word; product specification, flash characteristics): the serial line overruns.
class Flash {
 public:
  [[nodiscard]] static std::size_t size();
  [[nodiscard]] static std::span<const std::uint8_t> page(std::size_t n);
  static bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes);
  static bool erase(std::size_t n);
};

static_assert(bus::FlashPages<Flash>);

}  // namespace fencepost::mcu::nrf51
