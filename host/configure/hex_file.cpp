#include "host/configure/hex_file.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "firmware/record/decimal.hpp"

namespace fencepost::host {
namespace {

constexpr std::size_t kHead = 4;  // count, address of two bytes, kind
constexpr std::uint8_t kData = 0;
constexpr std::uint8_t kEnd = 1;
constexpr std::uint8_t kSegment = 2;
constexpr std::uint8_t kStartSegment = 3;
constexpr std::uint8_t kUpper = 4;
constexpr std::uint8_t kStart = 5;

// Bytes from pairs of digits; empty if they are none.
std::vector<std::uint8_t> octets(std::string_view digits) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    const int high = record::hex_value(digits[i]);
    const int low = record::hex_value(digits[i + 1]);
    if (high < 0 || low < 0) return {};
    bytes.push_back(static_cast<std::uint8_t>(high * 16 + low));
  }
  return digits.size() % 2 == 0 ? bytes : std::vector<std::uint8_t>();
}

class HexReader {
 public:
  /// The line's error, or nothing.
  std::optional<std::string> take(std::string_view line) {
    if (!line.starts_with(':')) return "is no Intel HEX: it does not begin with ':'";
    const std::vector<std::uint8_t> bytes = octets(line.substr(1));
    if (bytes.size() < kHead + 1 || bytes.size() != kHead + 1U + bytes[0])
      return "is cut off, or has other signs in it";
    unsigned sum = 0;
    for (const std::uint8_t byte : bytes) sum += byte;
    if ((sum & 0xFFU) != 0) return "has a wrong checksum";
    return obey(bytes[3], static_cast<std::uint32_t>(bytes[1] << 8 | bytes[2]),
                std::span(bytes).subspan(kHead, bytes[0]));
  }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] const ImageMemory& memory() const { return memory_; }

 private:
  std::optional<std::string> obey(std::uint8_t kind, std::uint32_t address, std::span<const std::uint8_t> data) {
    switch (kind) {
      case kData:
        if (memory_.put(upper_ + address, data)) return std::nullopt;
        return "lies too far from the lines before it for any part's memory";
      case kEnd: ended_ = true; return std::nullopt;
      case kSegment:
      case kUpper:
        if (data.size() != 2) break;
        upper_ = static_cast<std::uint32_t>(data[0] << 8 | data[1]) << (kind == kUpper ? 16U : 4U);
        return std::nullopt;
      case kStartSegment:
      case kStart: return std::nullopt;
      default: break;
    }
    return fmt::format("has a record of kind {:02X} that is not known", kind);
  }

  ImageMemory memory_;
  std::uint32_t upper_ = 0;
  bool ended_ = false;
};

std::string hex_line(std::uint16_t address, std::uint8_t kind, std::span<const std::uint8_t> data) {
  unsigned sum = static_cast<unsigned>(data.size()) + (address >> 8U) + (address & 0xFFU) + kind;
  std::string line = fmt::format(":{:02X}{:04X}{:02X}", data.size(), address, kind);
  for (const std::uint8_t byte : data) {
    sum += byte;
    line += fmt::format("{:02X}", byte);
  }
  return line + fmt::format("{:02X}\r\n", (0x100U - (sum & 0xFFU)) & 0xFFU);
}

}  // namespace

base::Result<ImageMemory, std::string> read_hex(std::string_view file) {
  HexReader reader;
  std::size_t number = 0;
  while (!file.empty() && !reader.ended()) {
    std::string_view line = file.substr(0, file.find('\n'));
    file.remove_prefix(std::min(line.size() + 1, file.size()));
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (line.empty()) continue;
    if (const auto problem = reader.take(line)) return fmt::format("line {} {}", number, *problem);
  }
  if (!reader.ended()) return std::string("the file is cut off: its last line is missing");
  return reader.memory();
}

std::string write_hex(const ImageMemory& memory) {
  constexpr std::uint64_t kLine = 16;
  std::string text;
  std::uint32_t upper = 0;
  for (std::uint64_t at = memory.begin(); at < memory.end();) {
    std::vector<std::uint8_t> data;
    const std::uint64_t first = at;
    for (; at < memory.end() && memory.known(at) && (data.empty() || at % kLine != 0); ++at)
      data.push_back(memory.at(at));
    if (data.empty()) {
      ++at;
      continue;
    }
    const auto high = static_cast<std::uint32_t>(first >> 16U);
    if (high != upper) {
      text += hex_line(0, kUpper, std::array{static_cast<std::uint8_t>(high >> 8U), static_cast<std::uint8_t>(high)});
      upper = high;
    }
    text += hex_line(static_cast<std::uint16_t>(first), kData, data);
  }
  return text + hex_line(0, kEnd, {});
}

}  // namespace fencepost::host
