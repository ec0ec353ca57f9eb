#include "hal/mcu/nrf51/flash.hpp"

#include <algorithm>

#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

constexpr std::uint32_t kFirstAddress = 0x0003'F800;
constexpr std::uint32_t kMaxPolls = 100'000;  // of some cycles each; the core stands still by itself

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

std::uint32_t address_of(std::size_t n, std::size_t offset) {
  return kFirstAddress + static_cast<std::uint32_t>(n * kFlashPage + offset);
}

}  // namespace

std::size_t Flash::size() { return kFlashPage; }

std::span<const std::uint8_t> Flash::page(std::size_t n) {
  return {reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(address_of(n, 0))), kFlashPage};
}

bool Flash::program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
  const Opened opened(kFlashWrite);
  for (std::size_t i = 0; i + bus::kFlashWord <= bytes.size(); i += bus::kFlashWord) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < bus::kFlashWord; ++k) word |= std::uint32_t{bytes[i + k]} << (8 * k);
    reg(address_of(n, offset + i)) = word;
    if (!await_bits(kFlashReady, 1, kMaxPolls)) return false;
  }
  return std::ranges::equal(bytes, page(n).subspan(offset, bytes.size()));
}

bool Flash::erase(std::size_t n) {
  const Opened opened(kFlashErase);
  reg(kFlashErasePage) = address_of(n, 0);
  const bool done = await_bits(kFlashReady, 1, kMaxPolls);
  return done && std::ranges::all_of(page(n), [](std::uint8_t byte) { return byte == 0xFF; });
}

}  // namespace fencepost::mcu::nrf51
