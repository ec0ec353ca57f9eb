#include "drivers/huskylens/frames.hpp"

#include <algorithm>

#include "drivers/wire/endian.hpp"

namespace fencepost::huskylens {
namespace {

constexpr std::uint8_t kFirst = 0x55;
constexpr std::uint8_t kSecond = 0xAA;
constexpr std::uint8_t kThird = 0x11;  // of HuskyLens 1; of 2 a command stands there, and none is this
constexpr std::size_t kData = 5;
constexpr std::size_t kObject = 10;  // data bytes of an INFO, a BLOCK, an ARROW, at least

struct Meaning {
  std::uint8_t command;
  Kind kind;
  std::size_t shortest;
  std::size_t longest;
};
constexpr Meaning kOne[] = {{0x29, Kind::kInfo, kObject, kObject},
                            {0x2A, Kind::kBlock, kObject, kObject},
                            {0x2B, Kind::kArrow, kObject, kObject},
                            {0x2E, Kind::kDone, 0, kLongestData},
                            {0x3C, Kind::kOther, 0, kLongestData},
                            {0x3D, Kind::kBusy, 0, 0},
                            {0x3E, Kind::kBusy, 0, 0}};
constexpr Meaning kTwo[] = {{0x40, Kind::kDone, 0, kLongestData},
                            {0x41, Kind::kBusy, 0, kLongestData},
                            {0x42, Kind::kInfo, kObject, kLongestData},
                            {0x43, Kind::kBlock, kObject, kLongestData},
                            {0x44, Kind::kArrow, kObject, kLongestData}};

std::uint8_t command_of(std::span<const std::uint8_t> frame) { return frame[2] == kThird ? frame[4] : frame[2]; }
std::size_t length_of(std::span<const std::uint8_t> frame) { return frame[2] == kThird ? frame[3] : frame[4]; }

/// Of its first five bytes; nothing: no answer has that command.
const Meaning* meaning_of(std::span<const std::uint8_t> frame) {
  const std::span<const Meaning> meanings = frame[2] == kThird ? std::span<const Meaning>(kOne) : kTwo;
  for (const Meaning& meaning : meanings) {
    if (meaning.command == command_of(frame)) return &meaning;
  }
  return nullptr;
}

// A damaged header is seen at once, not after the bytes that it promises.
bool plausible(std::span<const std::uint8_t> frame) {
  const Meaning* const meaning = meaning_of(frame);
  const std::size_t length = length_of(frame);
  return meaning != nullptr && length >= meaning->shortest && length <= meaning->longest;
}

struct Ends {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

// The pixel behind the middle of an even number of pixels is its centre.
Ends inside(std::int32_t centre, std::int32_t size, std::int32_t limit) {
  const std::int32_t first = centre - size / 2;
  return {std::max(first, std::int32_t{0}), std::min(first + size - 1, limit - 1)};
}

/// The pixels of an image with so many columns that have a part of these, of one with `from` columns.
Ends scaled(Ends ends, std::int32_t from, std::int32_t to) {
  return {ends.first * to / from, ((ends.last + 1) * to + from - 1) / from - 1};
}

}  // namespace

wire::Verdict examine(std::span<const std::uint8_t> bytes) {
  using wire::Front;
  if (bytes[0] != kFirst || (bytes.size() > 1 && bytes[1] != kSecond)) {
    return {Front::kNoise, wire::skip_to(bytes, kFirst)};
  }
  if (bytes.size() < kData) return {};
  if (!plausible(bytes)) return {Front::kNoise, wire::skip_to(bytes, kFirst)};
  const std::size_t size = kAround + length_of(bytes);
  if (bytes.size() < size) return {};
  unsigned sum = 0;
  for (std::size_t i = 0; i + 1 < size; ++i) sum += bytes[i];
  if (bytes[size - 1] != wire::low(sum)) return {Front::kDamaged, 1};
  return {Front::kMessage, size};
}

Message message_of(std::span<const std::uint8_t> frame) {
  const Meaning* const meaning = meaning_of(frame);
  return {frame[2] == kThird ? Generation::kOne : Generation::kTwo, meaning != nullptr ? meaning->kind : Kind::kOther,
          frame.subspan(kData, length_of(frame))};
}

// HuskyLens 2: how many ids there are, filler, objects, how many of them are learned, blocks, learned blocks.
Info info_in(const Message& message) {
  const std::span<const std::uint8_t> data = message.data;
  if (message.generation == Generation::kTwo) return {wire::little_u16(data, 2), data[0] > 0, std::nullopt};
  return {wire::little_u16(data, 0), wire::little_u16(data, 2) > 0, wire::little_u16(data, 4)};
}

std::uint16_t id_in(const Message& block) {
  return block.generation == Generation::kTwo ? block.data[0] : wire::little_u16(block.data, 8);
}

std::optional<sensor::Blob> blob_in(const Message& block, std::uint16_t width) {
  const bool two = block.generation == Generation::kTwo;
  const std::span<const std::uint8_t> box = block.data.subspan(two ? 2 : 0, 8);
  const std::int32_t columns = wire::little_u16(box, 4);
  const std::int32_t rows = wire::little_u16(box, 6);
  const std::uint16_t id = id_in(block);
  if (columns == 0 || rows == 0 || id == 0 || id > 255) return std::nullopt;
  const std::int32_t from = two ? kWidth2 : kWidth;
  Ends x = inside(static_cast<std::int16_t>(wire::little_u16(box, 0)), columns, from);
  Ends y = inside(static_cast<std::int16_t>(wire::little_u16(box, 2)), rows, two ? kHeight2 : kHeight);
  if (x.first > x.last || y.first > y.last) return std::nullopt;
  x = scaled(x, from, width);
  y = scaled(y, from, width);
  sensor::Blob blob;
  blob.signature = static_cast<std::uint8_t>(id);
  blob.x1 = static_cast<std::int16_t>(x.first);
  blob.x2 = static_cast<std::int16_t>(x.last);
  blob.y1 = static_cast<std::int16_t>(y.first);
  blob.y2 = static_cast<std::int16_t>(y.last);
  blob.cx = {5 * (x.first + x.last)};
  blob.cy = {5 * (y.first + y.last)};
  return blob;
}

}  // namespace fencepost::huskylens
