#include "drivers/pixy1/pixy1.hpp"

#include <algorithm>
#include <utility>

#include "drivers/serial/largest_first.hpp"
#include "drivers/wire/endian.hpp"

namespace fencepost::pixy1 {
namespace {

constexpr std::uint16_t kMark = 0xAA55;
constexpr std::uint16_t kColourCodeMark = 0xAA56;
constexpr base::Duration kPatience = base::milliseconds(500);

bool is_mark(std::uint16_t word) { return word == kMark || word == kColourCodeMark; }

bool sum_is_right(std::span<const std::uint8_t> block) {
  unsigned sum = 0;
  for (std::size_t at = 2 * kWord; at < block.size(); at += kWord) sum += wire::little_u16(block, at);
  return (sum & 0xFFFFU) == wire::little_u16(block, kWord);
}

// Two boxes of one signature of which the overlap is more than half of the larger: one thing of two images, 20 ms
// apart. A camera joins such blocks, so the mark between the images was lost.
bool is_same_thing(const sensor::Blob& a, const sensor::Blob& b) {
  const auto area = [](std::int32_t x1, std::int32_t y1, std::int32_t x2, std::int32_t y2) {
    return x1 > x2 || y1 > y2 ? 0 : (x2 - x1 + 1) * (y2 - y1 + 1);
  };
  const std::int32_t common =
      area(std::max(a.x1, b.x1), std::max(a.y1, b.y1), std::min(a.x2, b.x2), std::min(a.y2, b.y2));
  const std::int32_t larger = std::max(area(a.x1, a.y1, a.x2, a.y2), area(b.x1, b.y1, b.x2, b.y2));
  return a.signature == b.signature && 2 * common > larger;
}

bool is_twice(const sensor::BlobFrame& frame, const sensor::Blob& blob) {
  return std::any_of(frame.blobs.begin(), frame.blobs.end(),
                     [&blob](const sensor::Blob& one) { return is_same_thing(one, blob); });
}

}  // namespace

wire::Verdict examine(std::span<const std::uint8_t> bytes) {
  using wire::Front;
  constexpr wire::Verdict kDamaged = {Front::kDamaged, 1};
  const bool may_be_mark = bytes[0] == wire::low(kMark) || bytes[0] == wire::low(kColourCodeMark);
  if (bytes[0] != 0 && !may_be_mark) return kDamaged;
  if (bytes.size() < kWord) return {};
  const std::uint16_t first = wire::little_u16(bytes, 0);
  if (first == 0) return {Front::kMessage, kWord};
  if (!is_mark(first)) return kDamaged;
  if (bytes.size() < 2 * kWord) return {};
  // A block whose sum looks like a mark is taken for the beginning of an image: so does the camera's own library.
  if (is_mark(wire::little_u16(bytes, kWord))) return first == kMark ? wire::Verdict{Front::kMessage, kWord} : kDamaged;
  const std::size_t size = first == kMark ? kBlock : kColourCode;
  if (bytes.size() < size) return {};
  return sum_is_right(bytes.first(size)) ? wire::Verdict{Front::kMessage, size} : kDamaged;
}

std::optional<sensor::Blob> blob_of(std::span<const std::uint8_t> block) {
  const std::uint16_t signature = wire::little_u16(block, 4);
  const std::int32_t width = wire::little_u16(block, 10);
  const std::int32_t height = wire::little_u16(block, 12);
  const std::int32_t left = wire::little_u16(block, 6) - width / 2;
  const std::int32_t top = wire::little_u16(block, 8) - height / 2;
  const std::int32_t right = left + width - 1;
  const std::int32_t bottom =
      std::min<std::int32_t>(top + height, kHeight - 1);  // others that speak as a Pixy have 240
  if (signature == 0 || signature > 255 || width == 0) return std::nullopt;
  if (left < 0 || right >= kWidth || top < 0 || top >= kHeight) return std::nullopt;
  sensor::Blob blob;
  blob.signature = static_cast<std::uint8_t>(signature);
  blob.x1 = static_cast<std::int16_t>(left);
  blob.x2 = static_cast<std::int16_t>(right);
  blob.y1 = static_cast<std::int16_t>(top);
  blob.y2 = static_cast<std::int16_t>(bottom);
  blob.cx = {5 * (left + right)};
  blob.cy = {5 * (top + bottom)};
  return blob;
}

bool Images::take(std::span<const std::uint8_t> message, base::Time first_byte) {
  if (building_ && std::exchange(given_, false)) frame_ = {mark_, 0, {}};
  if (message.size() > kWord) {
    take_block(message);
    return false;
  }
  if (message[0] == 0) return take_idle(first_byte);
  const bool complete = end();
  begin(first_byte);
  return complete;
}

void Images::begin(base::Time first_byte) {
  building_ = true;
  damaged_ = false;
  any_ = false;
  last_ = mark_ = first_byte;
  given_ = true;
}

bool Images::end() {
  if (!building_) return false;
  building_ = false;
  // A mark alone is none of an image: the camera announces only those that have blocks.
  if (!damaged_ && any_) return give();
  ++counts_.broken;
  return false;
}

// Over a two-wire bus zeros come as soon as an image was read.
bool Images::take_idle(base::Time now) {
  if (building_) return end();
  if (!last_) last_ = now;
  if (now - *last_ < options_.empty_after) return false;
  last_ = now;
  frame_ = {now, 0, {}};
  return give();
}

void Images::take_block(std::span<const std::uint8_t> block) {
  if (!building_) return last_.reset();  // its mark was lost
  const std::uint16_t signature = wire::little_u16(block, 4);
  any_ = true;
  if (block.size() == kColourCode && signature > 255) {
    ++counts_.blobs_dropped;
    return;
  }
  const std::optional<sensor::Blob> blob = blob_of(block);
  if (!blob || is_twice(frame_, *blob)) {
    damaged_ = true;
  } else if (!serial::insert_largest_first(frame_, *blob)) {
    ++counts_.blobs_dropped;
  }
}

void Images::take_damage() {
  damaged_ = true;
  last_.reset();
}

bool Images::give() {
  saw_ = !frame_.blobs.empty();
  frame_.frame = counts_.frames++;
  return true;
}

void Images::reset() {
  building_ = damaged_ = false;
  last_.reset();
}

bool Session::take(std::uint8_t byte, base::Time now) {
  bool complete = false;
  byte_at_ = now;
  // Damage and messages in the order in which they stand in the stream: a mark behind damage begins a good image.
  std::uint32_t damaged = scanner_.damaged();
  const auto tell_damage = [&] {
    if (std::exchange(damaged, scanner_.damaged()) != scanner_.damaged()) images_.take_damage();
  };
  scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
    tell_damage();
    complete = images_.take(message, first_byte) || complete;
  });
  tell_damage();
  if (complete) frame_at_ = now;
  return complete;
}

void Session::step(base::Time now) {
  if (byte_at_ && now - *byte_at_ > kPatience) {
    link_lost();
  } else if (frame_at_ && now - *frame_at_ > kPatience) {
    frame_at_.reset();
  }
}

void Session::link_lost() {
  scanner_.reset();
  images_.reset();
  byte_at_.reset();
  frame_at_.reset();
}

sensor::LinkState Session::link() const {
  using enum sensor::LinkState;
  if (!byte_at_) return kSilent;
  if (!frame_at_) return kUnready;
  return images_.saw() ? kOk : kEmpty;
}

}  // namespace fencepost::pixy1
