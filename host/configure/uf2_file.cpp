#include "host/configure/uf2_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "host/configure/little_endian.hpp"

namespace fencepost::host {
namespace {

// Microsoft's specification of UF2.

constexpr std::uint32_t kFirstMark = 0x0A324655;
constexpr std::uint32_t kSecondMark = 0x9E5D5157;
constexpr std::uint32_t kLastMark = 0x0AB16F30;
constexpr std::uint32_t kFamilyPresent = 0x2000;
constexpr std::uint32_t kRp2040 = 0xE48BFF56;

// An RP2350's family: of its Arm cores, secure.
constexpr std::uint32_t kRp2350 = 0xE48BFF59;
// The block that an RP2350's boot ROM looks for (its datasheet, 5.9.5.1).
constexpr std::array<std::uint32_t, 5> kImageDef = {0xFFFF'DED3, 0x1021'0142, 0x0000'01FF, 0, 0xAB12'3579};
// Bytes of the flash in which it looks.
constexpr std::size_t kImageDefWithin = 4096;

constexpr std::size_t kBlock = 512;
constexpr std::size_t kDataAt = 32;
constexpr std::size_t kMaxData = 476;
constexpr std::size_t kPayload = 256;
// The RP2040's drive erases a sector at each block whose number is a multiple of 16, wherever its address is (erratum
// RP2040-E14). So the file has whole sectors; only the last one may end early.
constexpr std::size_t kSector = 4096;

std::uint32_t word(std::string_view block, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<std::uint8_t>(block[at + i]);
  return value;
}
std::uint32_t family_of(const ImageMemory& memory) {
  std::string block;
  for (const std::uint32_t value : kImageDef) put_little_endian(block, value);
  const auto place = find_mark(memory.bytes().first(std::min(kImageDefWithin, memory.bytes().size())), block);
  return place ? kRp2350 : kRp2040;
}

}  // namespace

bool looks_like_uf2(std::string_view file) { return file.starts_with("UF2\n"); }

base::Result<ImageMemory, std::string> read_uf2(std::string_view file) {
  if (file.size() % kBlock != 0) return fmt::format("the file is cut off: UF2 has blocks of {} bytes", kBlock);
  ImageMemory memory;
  for (std::size_t n = 0; n < file.size() / kBlock; ++n) {
    const std::string_view block = file.substr(n * kBlock, kBlock);
    const std::uint32_t size = word(block, 16);
    if (word(block, 0) != kFirstMark || word(block, 4) != kSecondMark || word(block, kBlock - 4) != kLastMark ||
        size > kMaxData) {
      return fmt::format("block {} is damaged", n);
    }
    const bool known = word(block, 28) == kRp2040 || word(block, 28) == kRp2350;
    if ((word(block, 8) & kFamilyPresent) != 0 && !known) {
      return std::string("this UF2 file is for no RP2040 or RP2350, the only parts here that take such files");
    }
    const std::vector<std::uint8_t> data(block.begin() + kDataAt, block.begin() + kDataAt + size);
    if (!memory.put(word(block, 12), data)) return fmt::format("block {} lies too far from the others", n);
  }
  return memory;
}

std::string write_uf2(const ImageMemory& memory) {
  std::vector<std::uint32_t> pages;
  for (std::uint64_t sector = memory.begin() / kSector * kSector; sector < memory.end(); sector += kSector) {
    bool known = false;
    for (std::uint64_t at = sector; at < sector + kSector; ++at) known = known || memory.known(at);
    if (!known) continue;
    const std::uint64_t end = std::min(sector + kSector, memory.end());
    for (std::uint64_t page = sector; page < end; page += kPayload) pages.push_back(static_cast<std::uint32_t>(page));
  }
  const std::uint32_t family = family_of(memory);
  std::string file;
  for (std::size_t n = 0; n < pages.size(); ++n) {
    for (const std::uint32_t value : std::array<std::uint32_t, 8>{kFirstMark, kSecondMark, kFamilyPresent, pages[n],
                                                                  kPayload, static_cast<std::uint32_t>(n),
                                                                  static_cast<std::uint32_t>(pages.size()), family}) {
      put_little_endian(file, value);
    }
    for (std::uint64_t at = pages[n]; at < pages[n] + kPayload; ++at)
      file.push_back(static_cast<char>(memory.known(at) ? memory.at(at) : 0xFF));
    file.append(kMaxData - kPayload, '\0');
    put_little_endian(file, kLastMark);
  }
  return file;
}

}  // namespace fencepost::host
