#include "host/emulate/models/pixy2.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
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

/// How far the firmware's tracker finds two boxes apart; nothing: too far for one thing in two frames.
std::optional<int> difference(const sensor::Blob& a, const sensor::Blob& b) {
  constexpr int kFarthest = 65;  // px, BL_MAX_TRACKING_DIST; of the centres' distance over the root of 2
  if (a.signature != b.signature) return std::nullopt;
  const auto squared = [](int value) { return value * value; };
  const int across = (a.x1 + a.x2 - b.x1 - b.x2) / 2;
  const int down = (a.y1 + a.y2 - b.y1 - b.y2) / 2;
  if (squared(across) + squared(down) > 2 * squared(kFarthest)) return std::nullopt;
  return squared(a.x1 - b.x1) + squared(a.x2 - b.x2) + squared(a.y1 - b.y1) + squared(a.y2 - b.y2);
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

void Pixy2::see(const std::vector<sensor::Blob>& blobs) { follow(blobs, kRepeated); }

void Pixy2::show(const std::vector<sensor::Blob>& blobs) { follow(blobs, 0); }

void Pixy2::follow(const std::vector<sensor::Blob>& blobs, int repeated) {
  struct Pair {
    int difference = 0;
    std::size_t block = 0;
    std::size_t blob = 0;
  };
  std::vector<Pair> pairs;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (std::size_t blob = 0; blob < blobs.size(); ++blob) {
      if (const auto apart = difference(blocks_[block].blob, blobs[blob])) pairs.push_back({*apart, block, blob});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::difference);
  std::vector<bool> is_found(blocks_.size());
  std::vector<bool> has_block(blobs.size());
  for (const Pair& pair : pairs) {
    if (is_found[pair.block] || has_block[pair.blob]) continue;
    is_found[pair.block] = has_block[pair.blob] = true;
    blocks_[pair.block].blob = blobs[pair.blob];
  }
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    Block& known = blocks_[block];
    known.age = static_cast<std::uint8_t>(std::min(known.age + 1, 0xFF));
    known.repeats = is_found[block] ? repeated : known.repeats - 1;
  }
  std::erase_if(blocks_, [](const Block& block) { return block.repeats < 0; });
  for (std::size_t blob = 0; blob < blobs.size(); ++blob) {
    if (!has_block[blob]) blocks_.push_back({blobs[blob], next_index_++, 0, repeated});
  }
  frame_is_new_ = true;
}

void Pixy2::put(Bytes& bytes, const Block& block) {
  const sensor::Blob& blob = block.blob;
  emulate::put(bytes, blob.signature);
  emulate::put(bytes, static_cast<unsigned>(blob.x1 + blob.x2 + 1) >> 1U);
  emulate::put(bytes, static_cast<unsigned>(blob.y1 + blob.y2) >> 1U);
  emulate::put(bytes, width(blob));
  emulate::put(bytes, height(blob));
  emulate::put(bytes, 0);  // angle: of colour codes only
  emulate::put(bytes, block.index | static_cast<unsigned>(block.age) << 8U);
}

void Pixy2::restart(base::Time now) {
  power_on_ = now;
  program_ = default_program_;
  received_.clear();
  blocks_.clear();
  next_index_ = 0;
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
  std::vector<Block> list;
  for (const Block& block : blocks_) {
    if (list.size() < kTransmitBlocks && selected(block.blob, data[0])) list.push_back(block);
  }
  const auto area = [](const Block& block) { return width(block.blob) * height(block.blob); };
  std::ranges::stable_sort(list, std::greater(), area);
  list.resize(std::min<std::size_t>(list.size(), data[1]));
  Bytes blocks;
  for (const Block& block : list) put(blocks, block);
  return packet(0x21, blocks);
}

Bytes Pixy2::packet(std::uint8_t type, const Bytes& data) {
  Bytes bytes = {0xAF, 0xC1, type, static_cast<std::uint8_t>(data.size())};
  emulate::put(bytes, std::accumulate(data.begin(), data.end(), 0U) & 0xFFFFU);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

Bytes Pixy2::error(int code) { return packet(0x03, {static_cast<std::uint8_t>(code)}); }

}  // namespace fencepost::emulate
