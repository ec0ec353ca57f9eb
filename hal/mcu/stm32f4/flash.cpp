#include "hal/mcu/stm32f4/flash.hpp"

#include <algorithm>

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/registers.hpp"
#include "hal/mcu/stm32f4/watchdog.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

constexpr std::uint32_t kFirstSector = 1;
constexpr std::uint32_t kMaxFlashPolls = 30'000'000;  // 0.5 s for an erasure, of a loop of some cycles

// The controller is locked again whatever happens in between.
class Unlocked {
 public:
  Unlocked() {
    reg(kFlashKey) = kFlashKey1;
    reg(kFlashKey) = kFlashKey2;
    reg(kFlashStatus) = kFlashErrors;  // a set bit is cleared by writing it
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() { reg(kFlashControl) = kFlashLock; }
};

bool settled() {
  for (std::uint32_t i = 0; i < kMaxFlashPolls; ++i) {
    const std::uint32_t status = reg(kFlashStatus);
    if ((status & kFlashBusy) == 0) return (status & kFlashErrors) == 0;
  }
  return false;
}

std::uint32_t address_of(std::size_t n, std::size_t offset) {
  return Flash::kAddress + static_cast<std::uint32_t>(n * Flash::size() + offset);
}

}  // namespace

std::span<const std::uint8_t> Flash::page(std::size_t n) {
  return {reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(address_of(n, 0))), kSize};
}

bool Flash::program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
  const Unlocked unlocked;
  reg(kFlashControl) = kFlashProgram | kFlashByWords;
  for (std::size_t i = 0; i + bus::kFlashWord <= bytes.size(); i += bus::kFlashWord) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < bus::kFlashWord; ++k) word |= std::uint32_t{bytes[i + k]} << (8 * k);
    reg(address_of(n, offset + i)) = word;
    if (!settled()) return false;
  }
  return std::ranges::equal(bytes, page(n).subspan(offset, bytes.size()));
}

bool Flash::erase(std::size_t n) {
  const PatientWatchdog watchdog;
  const Unlocked unlocked;
  reg(kFlashControl) =
      kFlashErase | kFlashByWords | ((kFirstSector + static_cast<std::uint32_t>(n)) << kFlashSectorShift);
  reg(kFlashControl) = reg(kFlashControl) | kFlashStart;
  const bool done = settled();
  // The data cache may still hold what was there before (3.5.5).
  clear_bits(kFlashAccess, 1U << 10);
  set_bits(kFlashAccess, 1U << 12);
  clear_bits(kFlashAccess, 1U << 12);
  set_bits(kFlashAccess, 1U << 10);
  return done && std::ranges::all_of(page(n), [](std::uint8_t byte) { return byte == 0xFF; });
}

}  // namespace fencepost::mcu::stm32f4
