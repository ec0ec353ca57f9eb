// Two pages of the part's own flash, for settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/flash_pages.hpp"
#include "hal/mcu/nrf51/registers.hpp"

namespace fencepost::mcu::nrf51 {

/// Words of bus::kFlashWord bytes, at an address that is a multiple of it. False if the part did not get ready, or the
/// words are not there afterwards.
bool program_words(std::uint32_t address, std::span<const std::uint8_t> bytes);
/// The page at its first address; false if the part did not get ready, or it is not empty.
bool erase_page(std::uint32_t address, std::size_t size);
/// The bytes that are there now.
std::span<const std::uint8_t> bytes_at(std::uint32_t address, std::size_t size);

/// Pages 0 and 1 from `kFirst` on, of `kPage` bytes each. Not inlined: the smallest part's flash is short.
template <std::uint32_t kFirst, std::uint32_t kPage>
class TwoPages {
 public:
  static constexpr std::uint32_t kAddress = kFirst;

  [[nodiscard]] static constexpr std::size_t size() { return kPage; }
  [[nodiscard]] static std::span<const std::uint8_t> page(std::size_t n) { return bytes_at(address_of(n), kPage); }
  [[gnu::noinline]] static bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
    return program_words(address_of(n) + static_cast<std::uint32_t>(offset), bytes);
  }
  [[gnu::noinline]] static bool erase(std::size_t n) { return erase_page(address_of(n), kPage); }

 private:
  static std::uint32_t address_of(std::size_t n) { return kFirst + kPage * static_cast<std::uint32_t>(n); }
};

/// The last two pages of 256 KB: the linker script leaves them free. The core stops while the flash erases (23 ms a
/// page) or writes (46 us a word), and the serial line overruns. Source: product specification, flash characteristics.
using Flash = TwoPages<0x0003'F800, kFlashPage>;
static_assert(bus::FlashPages<Flash>);

}  // namespace fencepost::mcu::nrf51
