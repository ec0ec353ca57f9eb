#include "host/emulate/models/huskylens2.hpp"

#include <utility>

#include "host/emulate/models/messages.hpp"
#include "host/text/plural.hpp"

namespace fencepost::emulate {
namespace {

constexpr int kColour2 = 5;
constexpr std::size_t kHeader2 = 5;

void add(Bytes& bytes, const Bytes& more) {
  for (const std::uint8_t byte : more) bytes.push_back(byte);
}

Bytes framed(std::uint8_t command, int algorithm, const Bytes& data) {
  Bytes bytes = {0x55, 0xAA, command, static_cast<std::uint8_t>(algorithm), static_cast<std::uint8_t>(data.size())};
  add(bytes, data);
  bytes.push_back(sum(bytes));
  return bytes;
}

/// Two bytes, then words: the start of each answer.
Bytes packet(int first, int second, std::initializer_list<int> words) {
  Bytes bytes = {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second)};
  for (const int word : words) {
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFF));
  }
  return bytes;
}

Bytes named(const std::string& name) {
  Bytes bytes = {static_cast<std::uint8_t>(name.size())};
  for (const char c : name) bytes.push_back(static_cast<std::uint8_t>(c));
  return bytes;
}

/// For an even number of pixels, the middle is reported as the pixel after it.
Bytes block2(const sensor::Blob& blob) {
  constexpr int kConfidence = 90;
  const int width = blob.x2 - blob.x1 + 1;
  const int height = blob.y2 - blob.y1 + 1;
  Bytes data = packet(blob.signature, kConfidence, {blob.x1 + width / 2, blob.y1 + height / 2, width, height});
  add(data, named("Color" + std::to_string(blob.signature)));
  add(data, named(""));
  return framed(0x43, kColour2, data);
}

}  // namespace

Bytes HuskyLens2::power_up(base::Time now) {
  power_on_ = now;
  received_.clear();
  algorithm_ = 0;
  return {};
}

Bytes HuskyLens2::see(const sensor::BlobFrame& frame, base::Time /*now*/) {
  show({frame.blobs.begin(), frame.blobs.end()});
  return {};
}

Bytes HuskyLens2::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kDeaf) return {};
  received_.push_back(byte);
  if (received_[0] != 0x55 || (received_.size() > 1 && received_[1] != 0xAA)) received_.clear();
  if (received_.size() < kHeader2 || received_.size() < kHeader2 + 1U + received_[4]) return {};
  const Bytes message = std::exchange(received_, {});
  const std::span<const std::uint8_t> view(message);
  if (sum(view.first(message.size() - 1)) != message.back()) return {};
  return answer(message[2], message[3], view.subspan(kHeader2, message[4]));
}

Bytes HuskyLens2::answer(std::uint8_t command, std::uint8_t algorithm, std::span<const std::uint8_t> data) {
  switch (command) {
    case 0x20: return framed(0x40, 0, packet(0, 0, {0, 0, 0, 0}));
    case 0x30:
      if (data.empty()) return framed(0x41, 0, packet(0, 0, {0, 0, 0, 0}));
      algorithm_ = data[0];
      return framed(0x40, 0, packet(0, 0, {0, 0, 0, 0}));
    case 0x21:
      used_ = true;
      if (algorithm != 0 && algorithm != algorithm_) return framed(0x41, algorithm, packet(0, 0, {0, 0, 0, 0}));
      return results();
    default: not_emulated_.note("command " + hex_of(Bytes{command})); return {};
  }
}

Bytes HuskyLens2::results() const {
  const int count = algorithm_ == kColour2 ? static_cast<int>(blobs_.size()) : 0;
  Bytes reply = framed(0x42, algorithm_, packet(learned_, 0, {count, count, count, count}));
  for (int i = 0; i < count; ++i) add(reply, block2(blobs_[static_cast<std::size_t>(i)]));
  return reply;
}

std::string describe_huskylens2(bool /*from_host*/, std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeader2 || bytes[0] != 0x55 || bytes[1] != 0xAA) return {};
  switch (bytes[2]) {
    case 0x11: return "knock of a HuskyLens 1";
    case 0x20: return "knock";
    case 0x21: return "ask results";
    case 0x30: return "set algorithm";
    case 0x40: return "OK";
    case 0x41: return "error";
    case 0x42: return bytes.size() > 7 ? "INFO, " + host::plural(bytes[7], "object") : "INFO";
    default: return {};
  }
}

}  // namespace fencepost::emulate
