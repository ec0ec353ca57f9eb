#include "hal/mcu/nrf51/flash.hpp"

#include <algorithm>

#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

// Of five cycles at least. The core stands still by itself, unless a cache holds this loop: an erasure of 85 ms is 1.1
// million polls at 64 MHz.
constexpr std::uint32_t kMaxPolls = 2'000'000;

// Read-only again, whatever happens in between.
class Opened {
 public:
  explicit Opened(std::uint32_t purpose) {
    reg(kFlashConfig) = purpose;
    static_cast<void>(await_bits(kFlashReady, 1, kMaxPolls));
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() { reg(kFlashConfig) = kFlashReadOnly; }
};

}  // namespace

std::span<const std::uint8_t> bytes_at(std::uint32_t address, std::size_t size) {
  return {reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(address)), size};
}

bool program_words(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  const Opened opened(kFlashWrite);
  for (std::size_t i = 0; i + bus::kFlashWord <= bytes.size(); i += bus::kFlashWord) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < bus::kFlashWord; ++k) word |= std::uint32_t{bytes[i + k]} << (8 * k);
    reg(address + static_cast<std::uint32_t>(i)) = word;
    if (!await_bits(kFlashReady, 1, kMaxPolls)) return false;
  }
  return std::ranges::equal(bytes, bytes_at(address, bytes.size()));
}

bool erase_page(std::uint32_t address, std::size_t size) {
  const Opened opened(kFlashErase);
  reg(kFlashErasePage) = address;
  const bool done = await_bits(kFlashReady, 1, kMaxPolls);
  return done && std::ranges::all_of(bytes_at(address, size), [](std::uint8_t byte) { return byte == 0xFF; });
}

}  // namespace fencepost::mcu::nrf51
