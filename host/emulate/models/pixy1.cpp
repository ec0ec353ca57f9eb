#include "host/emulate/models/pixy1.hpp"

#include <algorithm>
#include <utility>

#include "host/text/plural.hpp"

namespace fencepost::emulate {
namespace {

constexpr std::size_t kMaxBlocks = 100;
constexpr unsigned kNormal = 0xAA55;
constexpr unsigned kCode = 0xAA56;

int area(const sensor::Blob& blob) { return (blob.x2 + 1 - blob.x1) * (blob.y2 + 1 - blob.y1); }

/// Mark, sum, and the words that are summed.
Bytes block(unsigned mark, std::initializer_list<int> words) {
  unsigned sum = 0;
  for (const int word : words) sum += static_cast<unsigned>(word) & 0xFFFFU;
  Bytes bytes;
  put(bytes, mark);
  put(bytes, sum);
  for (const int word : words) put(bytes, static_cast<unsigned>(word));
  return bytes;
}

}  // namespace

Bytes Pixy1::power_up(base::Time now) {
  next_image_ = free_ = now + kStart;
  list_.clear();
  pulled_.clear();
  sent_ = codes_.size();
  return {};
}

// A command is a word FFxx, low byte last here, and its numbers.
Bytes Pixy1::take(std::uint8_t byte, base::Time /*now*/) {
  const std::uint8_t before = std::exchange(heard_, byte);
  if (before != 0) return {};
  if (byte == 0xFF) not_emulated_.note("servos");
  if (byte == 0xFE) not_emulated_.note("brightness");
  if (byte == 0xFD) not_emulated_.note("lamp");
  return {};
}

Bytes Pixy1::see(const sensor::BlobFrame& frame, base::Time /*now*/) {
  show({frame.blobs.begin(), frame.blobs.end()});
  return {};
}

void Pixy1::show(const std::vector<sensor::Blob>& blobs) { shown_ = blobs; }

void Pixy1::begin_image() {
  next_image_ = next_image_ + kImage;
  list_ = shown_;
  std::stable_sort(list_.begin(), list_.end(), [](const sensor::Blob& a, const sensor::Blob& b) {
    return a.signature != b.signature ? a.signature < b.signature : area(a) > area(b);
  });
  list_.resize(std::min(list_.size(), kMaxBlocks));
  sent_ = 0;
}

// Its columns end one past the last pixel, its rows with the last one.
Bytes Pixy1::next_block() {
  Bytes bytes;
  if (sent_ == 0) put(bytes, kNormal);
  Bytes one;
  if (sent_ < list_.size()) {
    const sensor::Blob& blob = list_[sent_];
    const int width = blob.x2 + 1 - blob.x1;
    const int height = blob.y2 - blob.y1;
    one = block(kNormal, {blob.signature, blob.x1 + width / 2, blob.y1 + height / 2, width, height});
  } else {
    const ColourCode& code = codes_[sent_ - list_.size()];
    const int width = code.right - code.left;
    const int height = code.bottom - code.top;
    one = block(kCode, {code.number, code.left + width / 2, code.top + height / 2, width, height, code.angle});
  }
  ++sent_;
  for (const std::uint8_t byte : one) bytes.push_back(byte);
  return bytes;
}

// Rounded up: a line that gets more than it can carry falls behind without end.
base::Duration Pixy1::time_of(std::size_t bytes) const {
  constexpr std::int64_t kBitsAByte = 10;
  constexpr std::int64_t kTicksASecond = base::milliseconds(1'000).raw;
  if (baud_ == 0) return {0};
  return {(kTicksASecond * kBitsAByte * static_cast<std::int64_t>(bytes) + baud_ - 1) / baud_};
}

std::optional<base::Time> Pixy1::next() const { return all_sent() ? next_image_ : std::min(next_image_, free_); }

Bytes Pixy1::step(base::Time now) {
  Bytes bytes;
  if (now >= next_image_) {
    begin_image();
    if (free_ <= now) put(bytes, 0);
  }
  while (!all_sent() && free_ <= now) {
    for (const std::uint8_t byte : next_block()) bytes.push_back(byte);
    if (baud_ != 0) break;
  }
  if (!bytes.empty()) free_ = now + time_of(bytes.size());
  return bytes;
}

Bytes Pixy1::pull(std::size_t count, base::Time now) {
  while (now >= next_image_) begin_image();
  Bytes bytes;
  while (bytes.size() < count) {
    if (pulled_.empty()) {
      Bytes more = {0, 0};
      if (!all_sent()) more = next_block();
      pulled_.assign(more.begin(), more.end());
    }
    bytes.push_back(pulled_.front());
    pulled_.pop_front();
  }
  return bytes;
}

std::string describe_pixy1(bool from_host, std::span<const std::uint8_t> bytes) {
  if (from_host) return {};
  std::size_t marks = 0;
  for (std::size_t at = 0; at + 1 < bytes.size(); ++at) {
    if ((bytes[at] == 0x55 || bytes[at] == 0x56) && bytes[at + 1] == 0xAA) ++marks;
  }
  if (marks == 0) return "nothing";
  const std::size_t blocks = bytes.size() / 14;
  return std::string(marks > blocks ? "image, " : "") + host::plural(blocks, "block");
}

}  // namespace fencepost::emulate
