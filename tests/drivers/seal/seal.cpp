#include "tests/drivers/seal/seal.hpp"

#include <algorithm>
#include <string_view>

#include "hal/base/crc16.hpp"

namespace fencepost::test {
namespace {

using Bytes = std::span<std::uint8_t>;

std::uint8_t low(unsigned value) { return static_cast<std::uint8_t>(value & 0xFFU); }

unsigned sum_of(std::span<const std::uint8_t> bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return sum;
}

bool starts(Bytes bytes, std::uint8_t first, std::uint8_t second) {
  return bytes.size() > 1 && bytes[0] == first && bytes[1] == second;
}

// `seal_first(rest)` seals a message at the front of what it is given and returns its size, or 0: none is there.
template <class SealFirst>
void seal_each(Bytes bytes, SealFirst&& seal_first) {
  while (!bytes.empty()) bytes = bytes.subspan(std::max<std::size_t>(seal_first(bytes), 1));
}

// The sum of all bytes before the last, in the last.
std::size_t seal_sum8(Bytes bytes, std::size_t size) {
  if (bytes.size() < size) return 0;
  bytes[size - 1] = low(sum_of(bytes.first(size - 1)));
  return size;
}

std::size_t seal_pixy1_block(Bytes bytes) {
  constexpr std::size_t kBlock = 14;
  constexpr std::size_t kColourCode = 16;
  if (!starts(bytes, 0x55, 0xAA) && !starts(bytes, 0x56, 0xAA)) return 0;
  const std::size_t size = bytes[0] == 0x55 ? kBlock : kColourCode;
  const bool begins_image = starts(bytes.subspan(2), 0x55, 0xAA) || starts(bytes.subspan(2), 0x56, 0xAA);
  if (bytes.size() < size || begins_image) return 0;
  unsigned sum = 0;
  for (std::size_t at = 4; at < size; at += 2) sum += bytes[at] + 256U * bytes[at + 1];
  bytes[2] = low(sum);
  bytes[3] = low(sum >> 8U);
  return size;
}

std::size_t seal_pixy2_packet(Bytes bytes) {
  constexpr std::size_t kHeader = 6;
  if (!starts(bytes, 0xAF, 0xC1) || bytes.size() < kHeader || bytes.size() < kHeader + bytes[3]) return 0;
  const unsigned sum = sum_of(bytes.subspan(kHeader, bytes[3]));
  bytes[4] = low(sum);
  bytes[5] = low(sum >> 8U);
  return kHeader + bytes[3];
}

// `seal_line(line)` is given each line without its end.
template <class SealLine>
void seal_lines(Bytes bytes, SealLine&& seal_line) {
  auto at = bytes.begin();
  while (at != bytes.end()) {
    const auto end = std::find(at, bytes.end(), '\n');
    std::size_t size = static_cast<std::size_t>(end - at);
    if (size > 0 && *(end - 1) == '\r') --size;
    const auto dollar = std::find(at, at + static_cast<std::ptrdiff_t>(size), '$');
    seal_line(Bytes(dollar, at + static_cast<std::ptrdiff_t>(size)));
    at = end == bytes.end() ? end : end + 1;
  }
}

void write_hex(Bytes digits, unsigned value) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  for (std::size_t i = digits.size(); i > 0; --i, value /= 16)
    digits[i - 1] = static_cast<std::uint8_t>(kDigits[value % 16]);
}

}  // namespace

void seal_create(Bytes bytes) {
  seal_each(bytes, [](Bytes rest) -> std::size_t {
    if (rest.size() < 3 || rest[0] != 0x13 || rest.size() < rest[1] + 3U) return 0;
    const std::size_t size = rest[1] + 3U;
    rest[size - 1] = low(0U - sum_of(rest.subspan(1, size - 2)));
    return size;
  });
}

void seal_huskylens(Bytes bytes) {
  seal_each(bytes, [](Bytes rest) -> std::size_t {
    if (!starts(rest, 0x55, 0xAA) || rest.size() < 5) return 0;
    return seal_sum8(rest, 6U + (rest[2] == 0x11 ? rest[3] : rest[4]));
  });
}

void seal_nxtcam5(Bytes bytes) {
  seal_each(bytes, [](Bytes rest) -> std::size_t {
    return starts(rest, 0x55, 0xAA) && rest.size() > 2 ? seal_sum8(rest, 5U + rest[2]) : 0;
  });
}

void seal_pixy1(Bytes bytes) { seal_each(bytes, seal_pixy1_block); }

void seal_pixy2(Bytes bytes) { seal_each(bytes, seal_pixy2_packet); }

void seal_xbc(Bytes bytes) {
  seal_lines(bytes, [](Bytes line) {
    if (line.size() < 4 || line[line.size() - 3] != '*') return;
    unsigned sum = 0;
    for (const std::uint8_t byte : line.subspan(1, line.size() - 4)) sum ^= byte;
    write_hex(line.last(2), sum);
  });
}

void seal_records(Bytes bytes) {
  seal_lines(bytes, [](Bytes line) {
    if (line.size() < 6 || line[line.size() - 5] != '*') return;
    const Bytes body = line.subspan(1, line.size() - 6);
    const auto* const text = static_cast<const char*>(static_cast<const void*>(body.data()));
    write_hex(line.last(4), base::crc16({text, body.size()}));
  });
}

}  // namespace fencepost::test
