#include "host/emulate/models/pixy2.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

#include "host/emulate/models/bytes.hpp"
#include "host/emulate/models/messages.hpp"

namespace fencepost::emulate {
namespace {

constexpr std::size_t kReceiveBuffer = 64;  // bytes for a program's name and its packet; longer requests are dropped
const std::string kBlobs = "color_connected_components";
constexpr std::size_t kTransmitBlocks = 18;  // of the transmit buffer: the list is cut before it is sorted

unsigned width(const sensor::Blob& blob) { return static_cast<unsigned>(blob.x2 + 1 - blob.x1); }
unsigned height(const sensor::Blob& blob) { return static_cast<unsigned>(blob.y2 - blob.y1); }

void put_block(Bytes& bytes, const sensor::Blob& blob) {
  put(bytes, blob.signature);
  put(bytes, static_cast<unsigned>(blob.x1 + blob.x2 + 1) >> 1U);
  put(bytes, static_cast<unsigned>(blob.y1 + blob.y2) >> 1U);
  put(bytes, width(blob));
  put(bytes, height(blob));
  put(bytes, 0);  // angle: of colour codes only
  put(bytes, 0xFF00U);
}

/// Name of a request that is acknowledged alone.
std::string_view without_effect(std::uint8_t type) {
  switch (type) {
    case 0x10: return "brightness";
    case 0x12: return "servos";
    case 0x14: return "LED";
    case 0x16: return "lamp";
    default: return {};
  }
}

bool selected(const sensor::Blob& blob, unsigned map) {
  return blob.signature > 7 ? (map & 0x80U) != 0 : (map >> (blob.signature - 1U) & 1U) != 0;
}

}  // namespace

void Pixy2::show(const std::vector<sensor::Blob>& blobs) {
  blobs_ = blobs;
  frame_is_new_ = true;
}

void Pixy2::restart(base::Time now) {
  power_on_ = now;
  program_ = default_program_;
  received_.clear();
  frame_is_new_ = false;
}

std::vector<std::uint8_t> Pixy2::take(std::uint8_t byte, base::Time now) {
  if (now - power_on_ < kDeaf) return {};
  received_.push_back(byte);
  const bool sync = received_[0] == 0xAE || received_[0] == 0xAF;
  if (!sync) received_.clear();
  if (received_.size() == 2 && received_[1] != 0xC1) {
    received_ = {byte};
    if (byte != 0xAE && byte != 0xAF) received_.clear();
  }
  if (!whole()) return {};
  const Bytes request = std::exchange(received_, {});
  const std::size_t header = request[0] == 0xAF ? 6 : 4;
  if (request.size() < header + request[3]) return {};  // too long: dropped
  const Bytes data(request.begin() + static_cast<std::ptrdiff_t>(header), request.end());
  const unsigned sum = std::accumulate(data.begin(), data.end(), 0U);
  if (header == 6 && (sum & 0xFFFFU) != (request[4] | static_cast<unsigned>(request[5]) << 8U)) return {};
  return answer(request[2], data, now);
}

bool Pixy2::whole() const {
  if (received_.size() < 4) return false;
  const std::size_t header = received_[0] == 0xAF ? 6 : 4;
  if (received_.size() < header) return false;
  return received_[3] > kReceiveBuffer || received_.size() == header + received_[3];
}

Bytes Pixy2::answer(std::uint8_t type, const Bytes& data, base::Time now) {
  const bool ready = now - power_on_ >= kBusy;
  if (const std::string_view name = without_effect(type); !name.empty()) not_emulated_.note(std::string(name));
  switch (type) {
    case 0x0E:
      if (!ready) return error(-2);
      return packet(0x0F, {0x00, 0x22, 3, 0, 20, 0, 'g', 'e', 'n', 'e', 'r', 'a', 'l', 0, 0, 0});
    case 0x0C:
      if (data.size() != 1) return error(-3);
      if (now - changed_ < kProgramChange) return error(-6);
      return program_ == "line_tracking" ? packet(0x0D, {79, 0, 52, 0}) : packet(0x0D, {0x3C, 0x01, 0xD0, 0x00});
    case 0x02: return answer_program(data, now);
    case 0x10: return data.size() == 1 ? packet(0x01, {0, 0, 0, 0}) : error(-3);
    case 0x12: return data.size() == 4 ? packet(0x01, {0, 0, 0, 0}) : error(-3);
    case 0x14: return data.size() == 3 ? packet(0x01, {0, 0, 0, 0}) : error(-3);
    case 0x16: return data.size() == 2 ? packet(0x01, {0, 0, 0, 0}) : error(-3);
    case 0x18: return packet(0x01, {61, 0, 0, 0});
    case 0x20: break;
    default: not_emulated_.note("request " + hex_of(Bytes{type})); return error(-4);
  }
  if (button_) return error(-5);
  if (now - changed_ < kProgramChange) return error(-6);
  if (program_ == kBlobs) return answer_blocks(data);
  // It changes program by itself and says so.
  program_ = kBlobs;
  changed_ = now;
  return error(-6);
}

Bytes Pixy2::answer_program(const Bytes& data, base::Time now) {
  const std::string name(data.begin(), std::find(data.begin(), data.end(), 0));
  for (const std::string& known : {kBlobs, std::string("line_tracking"), std::string("video")}) {
    if (known.compare(0, name.size(), name) != 0) continue;
    if (program_ != known) changed_ = now;
    program_ = known;
    const bool runs = now - changed_ >= kProgramChange;
    return packet(0x01, {static_cast<std::uint8_t>(runs ? 1 : 0), 0, 0, 0});
  }
  return error(-3);
}

Bytes Pixy2::answer_blocks(const Bytes& data) {
  if (data.size() != 2 || data[0] == 0) return error(-3);
  asked_ = true;
  if (!std::exchange(frame_is_new_, false)) return error(-2);
  std::vector<sensor::Blob> list;
  for (const sensor::Blob& blob : blobs_) {
    if (list.size() < kTransmitBlocks && selected(blob, data[0])) list.push_back(blob);
  }
  std::stable_sort(list.begin(), list.end(), [](const sensor::Blob& a, const sensor::Blob& b) {
    return width(a) * height(a) > width(b) * height(b);
  });
  list.resize(std::min<std::size_t>(list.size(), data[1]));
  Bytes blocks;
  for (const sensor::Blob& blob : list) put_block(blocks, blob);
  ++frames_sent_;
  return packet(0x21, blocks);
}

Bytes Pixy2::packet(std::uint8_t type, const Bytes& data) {
  Bytes bytes = {0xAF, 0xC1, type, static_cast<std::uint8_t>(data.size())};
  put(bytes, std::accumulate(data.begin(), data.end(), 0U) & 0xFFFFU);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

Bytes Pixy2::error(int code) { return packet(0x03, {static_cast<std::uint8_t>(code)}); }

}  // namespace fencepost::emulate
