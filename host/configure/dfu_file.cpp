#include "host/configure/dfu_file.hpp"

#include <cstdint>

#include "host/configure/little_endian.hpp"

// ST's UM0391, "DfuSe File Format Specification". The suffix is that of USB's DFU 1.1.
namespace fencepost::host {
namespace {

constexpr std::string_view kMark = "DfuSe";
constexpr std::size_t kPrefix = 11;              // bytes, as are the next three
constexpr std::size_t kTargetHead = 274;         // with the name
constexpr std::size_t kTargetName = 255;         // zeros behind it
constexpr std::size_t kElementHead = 8;          // address and size
constexpr std::uint16_t kStMicro = 0x0483;       // USB vendor
constexpr std::uint16_t kBootLoader = 0xDF11;    // USB product
constexpr std::uint16_t kDfuSeVersion = 0x011A;  // DFU 1.1a of ST
constexpr std::uint8_t kSuffix = 16;             // bytes

// Ethernet's CRC-32 without its last inversion.
std::uint32_t crc32(std::string_view text) {
  constexpr std::uint32_t kPolynomial = 0xEDB8'8320;
  std::uint32_t crc = ~0U;
  for (const char c : text) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? kPolynomial : 0);
  }
  return crc;
}

}  // namespace

bool looks_like_dfu(std::string_view file) { return file.starts_with(kMark); }

std::string write_dfu(const ImageMemory& memory) {
  const std::span<const std::uint8_t> bytes = memory.bytes();
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::string file(kMark);
  put_little_endian(file, 1, 1);  // version
  put_little_endian(file, static_cast<std::uint32_t>(kPrefix + kTargetHead + kElementHead + kSuffix) + size,
                    4);           // of the whole file
  put_little_endian(file, 1, 1);  // targets
  file += "Target";
  put_little_endian(file, 0, 1);  // alternate setting: the flash
  put_little_endian(file, 1, 4);  // has a name
  const std::string name = "ST...";
  file += name;
  file.append(kTargetName - name.size(), '\0');
  put_little_endian(file, static_cast<std::uint32_t>(kElementHead) + size, 4);
  put_little_endian(file, 1, 4);  // elements
  put_little_endian(file, memory.begin(), 4);
  put_little_endian(file, size, 4);
  file.append(bytes.begin(), bytes.end());
  put_little_endian(file, 0, 2);  // the device's version: any
  put_little_endian(file, kBootLoader, 2);
  put_little_endian(file, kStMicro, 2);
  put_little_endian(file, kDfuSeVersion, 2);
  file += "UFD";
  put_little_endian(file, kSuffix, 1);
  put_little_endian(file, crc32(file), 4);
  return file;
}

}  // namespace fencepost::host
