#include "host/emulate/models/huskylens.hpp"

#include <algorithm>
#include <array>

#include "host/emulate/models/messages.hpp"
#include "host/text/plural.hpp"

namespace fencepost::emulate {
namespace {

constexpr int kAny = -1;
constexpr int kNone = -2;  ///< no block has this id

Bytes framed(std::uint8_t command, const Bytes& data) {
  Bytes bytes = {0x55, 0xAA, 0x11, static_cast<std::uint8_t>(data.size()), command};
  // One by one: GCC 12 takes a vector's own insert() here for an access out of bounds when it optimises (-O3).
  for (const std::uint8_t byte : data) bytes.push_back(byte);
  bytes.push_back(sum(bytes));
  return bytes;
}

Bytes words(std::initializer_list<int> values) {
  Bytes bytes;
  for (const int value : values) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 0xFF));
  }
  return bytes;
}

/// For an even number of pixels, the middle is reported as the pixel after it.
Bytes block(const sensor::Blob& blob) {
  const int width = blob.x2 - blob.x1 + 1;
  const int height = blob.y2 - blob.y1 + 1;
  return framed(0x2A, words({blob.x1 + width / 2, blob.y1 + height / 2, width, height, blob.signature}));
}

}  // namespace

Bytes HuskyLens::power_up(base::Time now) {
  power_on_ = now;
  received_.clear();
  algorithm_ = left_in_;
  images_ = 0;
  return {};
}

void HuskyLens::show(const std::vector<sensor::Blob>& blobs) {
  blobs_ = blobs;
  ++images_;
}

Bytes HuskyLens::see(const sensor::BlobFrame& frame, base::Time /*now*/) {
  show({frame.blobs.begin(), frame.blobs.end()});
  return {};
}

Bytes HuskyLens::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kDeaf) return {};
  received_.push_back(byte);
  while (!received_.empty()) {
    constexpr std::uint8_t kStart[] = {0x55, 0xAA, 0x11};
    const bool start =
        std::equal(received_.begin(),
                   received_.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(received_.size(), 3)), kStart);
    if (start && received_.size() < 4) return {};
    const std::size_t size = start ? 6U + received_[3] : 0;
    if (start && received_[3] <= 128 && received_.size() < size) return {};
    if (start && received_[3] <= 128) {
      const Bytes message(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(size));
      received_.clear();
      const std::span<const std::uint8_t> view(message);
      if (sum(view.first(size - 1)) != message.back()) return {};
      return answer(message[4], view.subspan(5, message[3]));
    }
    received_.erase(received_.begin());
  }
  return {};
}

Bytes HuskyLens::answer(std::uint8_t command, std::span<const std::uint8_t> data) {
  if (busy_) return framed(0x3D, {});
  switch (command) {
    case 0x2C: return framed(0x2E, {});
    case 0x2D:
      if (data.size() == 2) algorithm_ = data[0];
      return framed(0x2E, {});
    case 0x20:
    case 0x21:
    case 0x23:
    case 0x24: return answer_blocks(kAny);
    case 0x26:
    case 0x27: return data.size() == 2 ? answer_blocks(data[0] + 256 * data[1]) : Bytes{};
    case 0x22:
    case 0x25:
    case 0x28: return answer_blocks(kNone);
    case 0x3C: return framed(0x3C, {5, '0', '.', '5', '.', '1'});
    case 0x2F:
    case 0x30:
    case 0x32:
    case 0x33:
    case 0x34:
    case 0x35:
    case 0x36:
    case 0x37:
    case 0x39: note(command); return framed(0x2E, {});
    default: note(command); return {};
  }
}

void HuskyLens::note(std::uint8_t command) {
  const std::string name = describe_huskylens(true, std::array<std::uint8_t, 6>{0x55, 0xAA, 0x11, 0, command, 0});
  not_emulated_.note(name.empty() ? "command " + hex_of(Bytes{command}) : name);
}

Bytes HuskyLens::answer_blocks(int id) {
  used_ = true;
  Bytes blocks;
  int count = 0;
  for (const sensor::Blob& blob : blobs_) {
    if (algorithm_ != kColours || (id != kAny && blob.signature != id)) continue;
    const Bytes bytes = block(blob);
    blocks.insert(blocks.end(), bytes.begin(), bytes.end());
    ++count;
  }
  Bytes reply = framed(0x29, words({count, learned_, images_, 0, 0}));
  reply.insert(reply.end(), blocks.begin(), blocks.end());
  return reply;
}

std::string describe_huskylens(bool from_host, std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 6 || bytes[0] != 0x55 || bytes[1] != 0xAA) return {};
  switch (bytes[4]) {
    case 0x20:
    case 0x21: return "ask blocks";
    case 0x22:
    case 0x25:
    case 0x28: return "ask arrows";
    case 0x2F: return "custom name";
    case 0x30: return "photo";
    case 0x32: return "save model";
    case 0x33: return "load model";
    case 0x34: return "text";
    case 0x35: return "clear text";
    case 0x36: return "learn";
    case 0x37: return "forget";
    case 0x39: return "screenshot";
    case 0x3B: return "is pro";
    case 0x23:
    case 0x24:
    case 0x26:
    case 0x27: return "ask blocks";
    case 0x29: return "INFO, " + host::plural(bytes[5], "object");
    case 0x2C: return "knock";
    case 0x2D: return "set algorithm";
    case 0x2E: return "OK";
    case 0x3C: return from_host ? "ask version" : "version";
    case 0x3D: return "busy";
    default: return {};
  }
}

}  // namespace fencepost::emulate
