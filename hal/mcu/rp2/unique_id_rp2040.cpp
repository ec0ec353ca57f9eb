// The flash chip's id: the RP2040 has none. Command 4Bh, four bytes without a meaning, then the id (W25Q16JV 8.2).
#include "hal/mcu/rp2/unique_id.hpp"

#include "hal/mcu/rp2/flash_access.hpp"

namespace fencepost::mcu::rp2 {
namespace {

constexpr std::uint8_t kReadUniqueId = 0x4B;
constexpr int kBytesBeforeId = 5;  // the command, and those without a meaning
constexpr int kIdBytes = 8;
constexpr std::uint32_t kMaxPolls = 1'000;  // a byte takes 48 cycles: the ROM sets the divider to 6

// By the pin's override: the SSI itself ends a command whenever it has nothing to send.
void select() {
  raise_bits(kFlashSelect, kFlashSelectLow);
  lower_bits(kFlashSelect, kFlashSelectHigh & ~kFlashSelectLow);
}
void deselect() { raise_bits(kFlashSelect, kFlashSelectHigh); }

// The ROM has set the SSI up so that a byte comes for each byte sent. All ones if none does.
std::uint8_t exchange(std::uint8_t byte) {
  reg(kSsiData) = byte;
  if (!await_bits(kSsiStatus, kSsiReceived, kMaxPolls)) return 0xFF;
  return static_cast<std::uint8_t>(reg(kSsiData));
}

}  // namespace

std::uint64_t read_unique_id() {
  const FlashAccess access;
  std::uint64_t id = 0;
  if (!access.whole()) return id;
  access.with([&id] {
    select();
    exchange(kReadUniqueId);
    for (int i = 1; i < kBytesBeforeId; ++i) exchange(0);
    for (int i = 0; i < kIdBytes; ++i) id = id << 8 | exchange(0);
    deselect();
  });
  return id;
}

}  // namespace fencepost::mcu::rp2
