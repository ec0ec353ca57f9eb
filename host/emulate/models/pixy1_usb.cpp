#include "host/emulate/models/pixy1_usb.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace fencepost::emulate {
namespace {

constexpr std::size_t kUsbTransfer = 64;
constexpr std::size_t kPixyHeader = 12;
constexpr std::uint8_t kRun = 5;
constexpr std::uint8_t kJunk = 0x5A;

/// Header and arguments: a value is at a multiple of its size, with its type in the byte before it.
class Message {
 public:
  explicit Message(std::uint8_t type, std::uint16_t procedure = 0) {
    bytes_ = {0x55,
              0x55,
              0xAA,
              0xAA,
              type,
              0,
              static_cast<std::uint8_t>(procedure & 0xFFU),
              static_cast<std::uint8_t>(procedure >> 8U),
              0,
              0,
              0,
              0};
  }
  void put(std::uint32_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> 8U * i & 0xFFU));
  }
  void put(std::uint8_t type, std::uint32_t value, std::size_t size) {
    bytes_.push_back(type);
    while (bytes_.size() % size != 0) bytes_.push_back(kJunk);
    bytes_.back() = type;
    put(value, size);
  }
  void put_words(const std::vector<int>& words) {
    put(0x82, static_cast<std::uint32_t>(words.size()), 4);
    for (const int word : words) put(static_cast<std::uint32_t>(word), 2);
  }
  Bytes sealed() {
    const std::size_t length = bytes_.size() - kPixyHeader;
    for (unsigned i = 0; i < 4; ++i) bytes_[8 + i] = static_cast<std::uint8_t>(length >> 8U * i & 0xFFU);
    if (bytes_.size() < kUsbTransfer) bytes_.resize(kUsbTransfer, kJunk);
    return bytes_;
  }

 private:
  Bytes bytes_;
};

Bytes result(std::uint8_t type, std::uint32_t value) {
  Message message(type, 0xFFFF);
  message.put(value, 4);
  return message.sealed();
}

}  // namespace

Bytes Pixy1Usb::power_up(base::Time now) {
  power_on_ = now;
  next_image_ = now + kStart;
  received_.clear();
  initialised_ = hints_ = false;
  running_ = true;
  return {};
}

Bytes Pixy1Usb::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kStart) return {};
  received_.push_back(byte);
  return received_.size() < kUsbTransfer ? Bytes{} : answer(std::exchange(received_, {}));
}

Bytes Pixy1Usb::answer(const Bytes& transfer) {
  constexpr std::uint8_t kMark[] = {0x55, 0x55, 0xAA, 0xAA};
  if (!std::equal(std::begin(kMark), std::end(kMark), transfer.begin())) return {};
  switch (transfer[4]) {
    case 0xA1: {
      initialised_ = transfer[14] != 0 || transfer[15] != 0;
      hints_ = transfer[17] != 0;
      Message message(0x61);
      message.put(0, 4);
      message.put(0x01, 1, 1);
      return message.sealed();
    }
    case 0xA0: {
      if (!initialised_) return {};
      const auto* const name = transfer.data() + kPixyHeader + 1;
      const auto* const end = std::find(name, transfer.data() + transfer.size(), 0);
      return result(0x60, std::string(name, end) == "run" ? kRun : 0xFFFFFFFFU);
    }
    case 0x80:
      if (!initialised_ || transfer[6] != kRun) return {};
      running_ = true;
      return result(0x40, 0);
    default: return {};
  }
}

Bytes Pixy1Usb::step(base::Time /*now*/) {
  next_image_ = next_image_ + kImage;
  if (!initialised_ || !running_) return {};
  Message message(0x18);
  if (hints_) {
    constexpr std::uint32_t kName = 0x00'42'43'43;  // "CCB"
    message.put(0x64, kName | static_cast<std::uint32_t>(codes_ ? '2' : '1') << 24U, 4);
    message.put(0x41, 1, 1);
    message.put(0x42, 320, 2);
    message.put(0x42, 200, 2);
  }
  std::vector<int> words;
  for (const sensor::Blob& blob : blobs_) {
    for (const int word : {int{blob.signature}, int{blob.x1}, blob.x2 + 1, int{blob.y1}, int{blob.y2}}) {
      words.push_back(word);
    }
  }
  message.put_words(words);
  if (codes_) message.put_words({});
  return message.sealed();
}

}  // namespace fencepost::emulate
