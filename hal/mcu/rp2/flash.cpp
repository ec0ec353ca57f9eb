#include "hal/mcu/rp2/flash.hpp"

#include <algorithm>
#include <array>

#include "hal/mcu/rp2/flash_access.hpp"
#include "hal/mcu/rp2/watchdog.hpp"

namespace fencepost::mcu::rp2 {
namespace {

constexpr std::uint32_t kFirst = Flash::kAddress - kFlashBase;  // from the flash's begin
constexpr std::size_t kChunk = 256;                             // the flash is written by pages of this size
constexpr std::uint32_t kEraseSector = 0x20;                    // its command

using Erase = void(std::uint32_t offset, std::size_t count, std::uint32_t block, std::uint8_t command);
using Program = void(std::uint32_t offset, const std::uint8_t* data, std::size_t count);

std::uint32_t offset_of(std::size_t n) { return kFirst + static_cast<std::uint32_t>(n * Flash::size()); }

}  // namespace

std::span<const std::uint8_t> Flash::page(std::size_t n) {
  return {reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(kFlashBase + offset_of(n))), kSector};
}

// By chunks that are all ones but for the bytes: those leave the flash as it is.
bool Flash::program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
  const FlashAccess access;
  auto* const change = rom_function<Program>(rom_code('R', 'P'));
  if (!access.whole() || change == nullptr) return false;
  std::array<std::uint8_t, kChunk> chunk{};
  for (std::size_t done = 0; done < bytes.size();) {
    const std::size_t at = (offset + done) % kChunk;
    const std::size_t count = std::min(bytes.size() - done, kChunk - at);
    chunk.fill(0xFF);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(done), count,
                chunk.begin() + static_cast<std::ptrdiff_t>(at));
    const auto target = offset_of(n) + static_cast<std::uint32_t>(offset + done - at);
    access.with([&] { change(target, chunk.data(), kChunk); });
    done += count;
  }
  return std::ranges::equal(bytes, page(n).subspan(offset, bytes.size()));
}

bool Flash::erase(std::size_t n) {
  const FlashAccess access;
  auto* const change = rom_function<Erase>(rom_code('R', 'E'));
  if (!access.whole() || change == nullptr) return false;
  const PatientWatchdog watchdog;
  access.with([&] { change(offset_of(n), kSector, kSector, kEraseSector); });
  return std::ranges::all_of(page(n), [](std::uint8_t byte) { return byte == 0xFF; });
}

}  // namespace fencepost::mcu::rp2
