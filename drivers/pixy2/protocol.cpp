#include "drivers/pixy2/protocol.hpp"

#include <array>
#include <string_view>

#include "drivers/serial/largest_first.hpp"
#include "drivers/wire/endian.hpp"

namespace fencepost::pixy2 {
namespace {

constexpr std::size_t kBlock = 14;
constexpr std::size_t kIndex = 12;  // of the tracker, in a block
constexpr std::size_t kVersionLength = 16;

bool is(const Packet& packet, Type type, std::size_t length) {
  return packet.type == type && packet.data.size() == length;
}

std::uint16_t sum(std::span<const std::uint8_t> data) {
  unsigned total = 0;
  for (const std::uint8_t byte : data) total += byte;
  return static_cast<std::uint16_t>(total & 0xFFFFU);
}

// Of the possible replies only: a damaged header is detected at once, not after the announced bytes.
bool plausible(Type type, std::size_t length) {
  switch (type) {
    case Type::kResult:
    case Type::kResolution: return length == 4;
    case Type::kError: return length == 1;
    case Type::kVersion: return length == kVersionLength;
    case Type::kBlocks: return length % kBlock == 0;
    default: return false;
  }
}

struct Edges {
  std::int32_t first = 0;
  std::int32_t last = 0;
  std::int32_t twice_middle = 0;
};

// Centre rounded down, and the difference of the edges, which for columns counts the pixels.
Edges columns(std::int32_t centre, std::int32_t width) {
  const std::int32_t left = centre - width / 2;
  return {left, left + width - 1, 2 * left + width - 1};
}

Edges rows(std::int32_t centre, std::int32_t height) {
  const std::int32_t top = centre - height / 2;
  return {top, top + height, 2 * top + height};
}

bool inside(const Edges& edges, std::int32_t size) {
  return edges.first >= 0 && edges.first <= edges.last && edges.last < size;
}

// Empty if the box is impossible; the caller sets the signature.
std::optional<sensor::Blob> box(std::span<const std::uint8_t> block) {
  const Edges x = columns(wire::little_u16(block, 2), wire::little_u16(block, 6));
  const Edges y = rows(wire::little_u16(block, 4), wire::little_u16(block, 8));
  if (!inside(x, kBlobResolution.width) || !inside(y, kBlobResolution.height)) return std::nullopt;
  sensor::Blob blob;
  blob.x1 = static_cast<std::int16_t>(x.first);
  blob.x2 = static_cast<std::int16_t>(x.last);
  blob.y1 = static_cast<std::int16_t>(y.first);
  blob.y2 = static_cast<std::int16_t>(y.last);
  blob.cx = {x.twice_middle * 5};
  blob.cy = {y.twice_middle * 5};
  return blob;
}

void append(Request& request, std::span<const std::uint8_t> bytes) {
  bool fits = true;
  for (const std::uint8_t byte : bytes) fits = request.push_back(byte) && fits;
  FENCEPOST_CHECK(fits);
}

}  // namespace

Request make_request(Type type, std::span<const std::uint8_t> data) {
  const std::uint16_t checksum = sum(data);
  const std::array<std::uint8_t, kHeader> header = {kSync,
                                                    kSecondSync,
                                                    static_cast<std::uint8_t>(type),
                                                    static_cast<std::uint8_t>(data.size()),
                                                    wire::low(checksum),
                                                    wire::high(checksum)};
  Request request;
  append(request, header);
  append(request, data);
  return request;
}

Request behind_padding(const Request& request) {
  constexpr std::uint8_t kFiller = 0x01;
  Request padded;
  for (std::size_t i = 0; i < kPadding; ++i) (void)padded.push_back(kFiller);
  append(padded, request.view());
  return padded;
}

Request request_version() { return make_request(Type::kGetVersion, {}); }

Request request_program() {
  constexpr std::string_view kName = "color_connected_components";
  std::array<std::uint8_t, kProgramName> data{};
  for (std::size_t i = 0; i < kName.size(); ++i) data[i] = static_cast<std::uint8_t>(kName[i]);
  return make_request(Type::kChangeProgram, data);
}

Request request_resolution() { return make_request(Type::kGetResolution, std::array<std::uint8_t, 1>{}); }

Request request_blocks(std::uint8_t signatures) {
  return make_request(Type::kGetBlocks, std::array<std::uint8_t, 2>{signatures, 0xFF});
}

wire::Verdict examine(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != kSync) return {wire::Front::kNoise, wire::skip_to(bytes, kSync)};
  if (bytes.size() >= 2 && bytes[1] != kSecondSync) return {wire::Front::kNoise, wire::skip_to(bytes, kSync)};
  if (bytes.size() >= 4 && !plausible(static_cast<Type>(bytes[2]), bytes[3])) {
    return {wire::Front::kDamaged, wire::skip_to(bytes, kSync)};
  }
  if (bytes.size() < kHeader || bytes.size() < kHeader + bytes[3]) return {};
  const std::size_t size = kHeader + bytes[3];
  if (sum(bytes.subspan(kHeader, bytes[3])) != wire::little_u16(bytes, 4)) {
    return {wire::Front::kDamaged, wire::skip_to(bytes, kSync)};
  }
  return {wire::Front::kMessage, size};
}

wire::Verdict examine_request(std::span<const std::uint8_t> bytes) {
  const bool starts = bytes[0] == kSync && (bytes.size() < 2 || bytes[1] == kSecondSync);
  if (!starts || (bytes.size() >= 4 && bytes[3] > kProgramName)) {
    return {wire::Front::kNoise, wire::skip_to(bytes, kSync)};
  }
  if (bytes.size() < kHeader || bytes.size() < kHeader + bytes[3]) return {};
  return {wire::Front::kMessage, kHeader + bytes[3]};
}

Packet packet_of(std::span<const std::uint8_t> message) {
  return {static_cast<Type>(message[2]), message.subspan(kHeader)};
}

std::optional<Version> version_in(const Packet& packet) {
  if (!is(packet, Type::kVersion, kVersionLength)) return std::nullopt;
  Version version{
      wire::little_u16(packet.data, 0), packet.data[2], packet.data[3], wire::little_u16(packet.data, 4), {}};
  for (const std::uint8_t byte : packet.data.subspan(6)) {
    if (byte == 0 || !version.type.push_back(static_cast<char>(byte))) break;
  }
  return version;
}

std::optional<std::int32_t> result_in(const Packet& packet) {
  if (!is(packet, Type::kResult, 4)) return std::nullopt;
  return wire::little_i32(packet.data, 0);
}

std::optional<DeviceError> error_in(const Packet& packet) {
  if (!is(packet, Type::kError, 1)) return std::nullopt;
  return static_cast<DeviceError>(static_cast<std::int8_t>(packet.data[0]));
}

std::optional<Resolution> resolution_in(const Packet& packet) {
  if (!is(packet, Type::kResolution, 4)) return std::nullopt;
  return Resolution{wire::little_u16(packet.data, 0), wire::little_u16(packet.data, 2)};
}

std::optional<Blocks> blocks_in(const Packet& packet) {
  if (packet.type != Type::kBlocks || packet.data.size() % kBlock != 0) return std::nullopt;
  Blocks blocks;
  for (std::size_t at = 0; at < packet.data.size(); at += kBlock) {
    const std::span<const std::uint8_t> block = packet.data.subspan(at, kBlock);
    const std::uint16_t signature = wire::little_u16(block, 0);
    std::optional<sensor::Blob> blob = box(block);
    if (!blob || signature == 0) return std::nullopt;
    blob->signature = static_cast<std::uint8_t>(signature);
    blob->track = static_cast<std::uint16_t>(block[kIndex] + 1);
    if (signature > 0xFF || !serial::insert_largest_first(blocks.frame, *blob)) ++blocks.dropped;
  }
  return blocks;
}

}  // namespace fencepost::pixy2
