#include "drivers/nxtcam/serial.hpp"

#include "drivers/serial/largest_first.hpp"

namespace fencepost::nxtcam {
namespace {

constexpr std::uint8_t kStart = 0x0A;
constexpr std::uint8_t kEnd = 0xFF;
constexpr std::size_t kLongestLine = 32;
constexpr std::uint8_t kV5Start = 0x55;
constexpr std::uint8_t kV5Second = 0xAA;
constexpr std::uint8_t kV5Blob = 4;
constexpr std::size_t kV5Overhead = 5;
constexpr std::size_t kV5BlobLength = 7;

bool printable(std::uint8_t byte) { return byte >= ' ' && byte <= '~'; }

wire::Verdict examine_line(std::span<const std::uint8_t> bytes) {
  std::size_t size = 0;
  while (size < bytes.size() && printable(bytes[size])) ++size;
  if (size > kLongestLine) return {wire::Front::kNoise, 1};
  if (size == bytes.size()) return {};
  if (size > 0 && bytes[size] == '\r') return {wire::Front::kMessage, size + 1};
  return {wire::Front::kNoise, size + (bytes[size] == kStart ? 0U : 1U)};
}

std::uint8_t sum(std::span<const std::uint8_t> bytes) {
  unsigned total = 0;
  for (const std::uint8_t byte : bytes) total += byte;
  return static_cast<std::uint8_t>(total & 0xFFU);
}

}  // namespace

wire::Verdict examine_avrcam(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != kStart) return examine_line(bytes);
  if (bytes.size() < 2) return {};
  if (bytes[1] > kMaxObjects) return {wire::Front::kDamaged, 1};
  const std::size_t size = 3 + bytes[1] * kObjectSize;
  // An impossible object ends the wait for the rest.
  for (std::size_t at = 2, i = 0; i < bytes[1] && at + kObjectSize <= bytes.size(); at += kObjectSize, ++i) {
    if (!object_in(bytes.subspan(at, kObjectSize))) return {wire::Front::kDamaged, 1};
  }
  if (bytes.size() < size) return {};
  if (bytes[size - 1] != kEnd) return {wire::Front::kDamaged, 1};
  return {wire::Front::kMessage, size};
}

std::optional<sensor::BlobFrame> tracking_in(std::span<const std::uint8_t> message) {
  if (message.empty() || message[0] != kStart) return std::nullopt;
  sensor::BlobFrame frame;
  for (std::size_t at = 2; at + 1 < message.size(); at += kObjectSize) {
    const std::optional<sensor::Blob> blob = object_in(message.subspan(at, kObjectSize));
    if (!blob) return std::nullopt;
    (void)serial::insert_largest_first(frame, *blob);
  }
  return frame;
}

std::string_view line_in(std::span<const std::uint8_t> message) {
  if (message.size() < 2 || message[0] == kStart) return {};
  return {static_cast<const char*>(static_cast<const void*>(message.data())), message.size() - 1};
}

wire::Verdict examine_v5(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != kV5Start) return {wire::Front::kNoise, wire::skip_to(bytes, kV5Start)};
  if (bytes.size() < 2) return {};
  if (bytes[1] != kV5Second) return {wire::Front::kNoise, wire::skip_to(bytes, kV5Start)};
  if (bytes.size() < 4) return {};
  const bool possible = bytes[3] == kV5Blob ? bytes[2] == kV5BlobLength : bytes[2] <= kLongestV5 - kV5Overhead;
  if (!possible) return {wire::Front::kDamaged, wire::skip_to(bytes, kV5Start)};
  const std::size_t size = kV5Overhead + bytes[2];
  if (bytes.size() < size) return {};
  const bool whole = sum(bytes.first(size - 1)) == bytes[size - 1];
  return whole ? wire::Verdict{wire::Front::kMessage, size}
               : wire::Verdict{wire::Front::kDamaged, wire::skip_to(bytes, kV5Start)};
}

std::optional<V5Blob> v5_blob_in(std::span<const std::uint8_t> message) {
  if (message.size() != kV5Overhead + kV5BlobLength || message[3] != kV5Blob) return std::nullopt;
  const std::span<const std::uint8_t> data = message.subspan(4, kV5BlobLength);
  if (data[3] >= data[5] || data[4] >= data[6] || data[5] > kV5Width || data[6] > kV5Height) return std::nullopt;
  V5Blob out;
  out.frame = data[0];
  out.blob.signature = data[2];
  out.blob.x1 = data[3];
  out.blob.y1 = data[4];
  out.blob.x2 = static_cast<std::int16_t>(data[5] - 1);
  out.blob.y2 = static_cast<std::int16_t>(data[6] - 1);
  out.blob.cx = {(out.blob.x1 + out.blob.x2) * 5};
  out.blob.cy = {(out.blob.y1 + out.blob.y2) * 5};
  return out;
}

}  // namespace fencepost::nxtcam
