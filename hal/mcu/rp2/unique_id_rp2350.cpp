// The chip's own id, by the boot ROM's get_sys_info (RP2350 datasheet 5.4.8.17).
#include "hal/mcu/rp2/unique_id.hpp"

#include <array>

#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {

std::uint64_t read_unique_id() {
  using GetSysInfo = int(std::uint32_t * words, std::size_t size, std::uint32_t what);
  auto* const get = rom_function<GetSysInfo>(rom_code('G', 'S'));
  if (get == nullptr) return 0;
  std::array<std::uint32_t, 4> words{};  // flags; package; lower and upper half of the id
  const int count = get(words.data(), words.size(), kRomChipInfo);
  if (count != static_cast<int>(words.size()) || words[0] != kRomChipInfo) return 0;
  return static_cast<std::uint64_t>(words[3]) << 32 | words[2];
}

}  // namespace fencepost::mcu::rp2
