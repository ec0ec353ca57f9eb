#include "host/emulate/models/pixy2_usb.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace fencepost::emulate {
namespace {

constexpr std::size_t kTransfer = 64;
constexpr std::size_t kChirpHeader = 12;

}  // namespace

void Pixy2Usb::restart(base::Time now) {
  camera_.restart(now);
  initialised_ = false;
  received_.clear();
}

std::vector<std::uint8_t> Pixy2Usb::take(std::uint8_t byte, base::Time now) {
  received_.push_back(byte);
  if (received_.size() < kTransfer) return {};
  return answer(std::exchange(received_, {}), now);
}

Pixy2Usb::Bytes Pixy2Usb::message(std::uint8_t type, std::uint16_t procedure, const Bytes& payload) {
  Bytes bytes = {0x55,
                 0x55,
                 0xAA,
                 0xAA,
                 type,
                 0,
                 static_cast<std::uint8_t>(procedure & 0xFFU),
                 static_cast<std::uint8_t>(procedure >> 8U)};
  const std::size_t length = payload.size();
  for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(length >> shift & 0xFFU));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  if (bytes.size() < kTransfer) bytes.resize(kTransfer, 0x55);
  return bytes;
}

std::vector<std::uint8_t> Pixy2Usb::pushed(std::size_t length) { return message(0x18, 0, Bytes(length, 0xA5)); }

Pixy2Usb::Bytes Pixy2Usb::answer(const Bytes& transfer, base::Time now) {
  if (transfer[0] != 0x55 || transfer[1] != 0x55 || transfer[2] != 0xAA || transfer[3] != 0xAA) return {};
  if (transfer[4] == 0xA1) {
    initialised_ = true;
    return message(0x61, 0, {0, 0, 0, 0, 0x01, 0x01});
  }
  if (!initialised_) return {};
  if (transfer[4] == 0xA0) {
    const std::string name(transfer.begin() + kChirpHeader + 1,
                           std::find(transfer.begin() + kChirpHeader + 1, transfer.end(), 0));
    const bool known = name == "ser_packet";
    const auto filler = static_cast<std::uint8_t>(known ? 0 : 0xFF);
    return message(0x60, 0xFFFF, {known ? kProcedure : filler, filler, filler, filler});
  }
  return transfer[4] == 0x80 && transfer[6] == kProcedure ? call(transfer, now) : Bytes{};
}

// 01 type, 81 81, count in four bytes, data.
Pixy2Usb::Bytes Pixy2Usb::call(const Bytes& transfer, base::Time now) {
  const std::size_t count = transfer[16];
  if (transfer[12] != 0x01 || transfer[14] != 0x81 || 20 + count > kTransfer) return {};
  Bytes request = {0xAE, 0xC1, transfer[13], transfer[16]};
  for (std::size_t i = 0; i < count; ++i) request.push_back(transfer[20 + i]);
  Bytes reply;
  for (const std::uint8_t byte : request) {
    for (const std::uint8_t answered : camera_.take(byte, now)) reply.push_back(answered);
  }
  if (reply.size() < 6) return {};
  Bytes payload = {0, 0, 0, 0, 0x01, reply[2], 0x81, 0x81, reply[3], 0, 0, 0};
  for (std::size_t i = 6; i < reply.size(); ++i) payload.push_back(reply[i]);
  return message(0x40, 0xFFFF, payload);
}

}  // namespace fencepost::emulate
