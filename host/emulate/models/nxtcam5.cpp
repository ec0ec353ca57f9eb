#include "host/emulate/models/nxtcam5.hpp"

#include <utility>

namespace fencepost::emulate {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kMessageHeader = 4;
constexpr std::size_t kLongestCommand = 8;  ///< bytes of data; more is taken for noise
constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kCommand = 3;
constexpr std::uint8_t kBlob = 4;

std::uint8_t low(int value) { return static_cast<std::uint8_t>(value); }

}  // namespace

void NxtCam5::restart(base::Time now) {
  power_on_ = now;
  received_.clear();
  tracking_ = !answers_;
}

void NxtCam5::set_answers(bool answers) {
  answers_ = answers;
  tracking_ = !answers;
}

Bytes NxtCam5::take(std::uint8_t byte, base::Time now) {
  if (!answers_ || now - power_on_ < kBoot) return {};
  received_.push_back(byte);
  if (received_[0] != 0x55) received_.clear();
  if (received_.size() == 2 && received_[1] != 0xAA) received_.clear();
  if (received_.size() < kMessageHeader) return {};
  if (received_[2] > kLongestCommand) {
    received_.clear();
    return {};
  }
  if (received_.size() < kMessageHeader + 1U + received_[2]) return {};
  return obey(std::exchange(received_, {}));
}

Bytes NxtCam5::obey(const Bytes& message) {
  const Bytes body(message.begin() + kMessageHeader, message.end() - 1);
  if (framed(message[3], body) != message) return {};
  if (message[3] == kCommand && body == Bytes{'E'}) tracking_ = true;
  return message[3] == kVersion ? framed(kVersion, {'5', '.', '0', '1'}) : Bytes{};
}

// The far corner is one past the last pixel.
Bytes NxtCam5::image(const std::vector<sensor::Blob>& blobs, base::Time now) {
  ++count_;
  if (!tracking_ || now - power_on_ < kBoot) return {};
  Bytes bytes;
  for (const sensor::Blob& blob : blobs) {
    const Bytes part =
        framed(kBlob, {count_, 0, blob.signature, low(blob.x1), low(blob.y1), low(blob.x2 + 1), low(blob.y2 + 1)});
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

Bytes NxtCam5::framed(std::uint8_t type, const Bytes& body) {
  Bytes bytes = {0x55, 0xAA, static_cast<std::uint8_t>(body.size()), type};
  for (const std::uint8_t byte : body) bytes.push_back(byte);
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  bytes.push_back(low(static_cast<int>(sum & 0xFFU)));
  return bytes;
}

}  // namespace fencepost::emulate
