#include "drivers/nxtcam/registers.hpp"

#include <algorithm>
#include <string_view>

namespace fencepost::nxtcam {
namespace {

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view text) {
  if (bytes.size() < text.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (bytes[i] != static_cast<std::uint8_t>(text[i])) return false;
  }
  return true;
}

}  // namespace

bool is_nxtcam(std::span<const std::uint8_t> bytes) {
  return bytes.size() == 16 && starts_with(bytes, "mndsnsrs") && starts_with(bytes.subspan(8), "NXTCam");
}

std::uint8_t taught_colours(std::span<const std::uint8_t> map) {
  constexpr std::size_t kChannel = kColourMapSize / 3;
  unsigned taught = map.size() == kColourMapSize ? 0xFFU : 0U;
  for (std::size_t start = 0; start + kChannel <= map.size(); start += kChannel) {
    unsigned channel = 0;
    for (const std::uint8_t entry : map.subspan(start, kChannel)) channel |= entry;
    taught &= channel;
  }
  return static_cast<std::uint8_t>(taught);
}

std::optional<sensor::Blob> object_in(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kObjectSize || bytes[0] >= kMaxObjects) return std::nullopt;
  const bool doubled = (bytes[1] | bytes[3]) % 2 == 0;
  const int last_column = bytes[3] + (doubled ? 1 : 0);
  if (bytes[1] > bytes[3] || bytes[2] > bytes[4] || bytes[3] > kWidth || bytes[4] > kHeight) return std::nullopt;
  const auto on_image = [](int value, std::int16_t size) {
    return static_cast<std::int16_t>(std::min<int>(value, size - 1));
  };
  sensor::Blob blob;
  blob.signature = bytes[0];
  blob.x1 = on_image(bytes[1], kWidth);
  blob.y1 = on_image(bytes[2], kHeight);
  blob.x2 = on_image(last_column, kWidth);
  blob.y2 = on_image(bytes[4], kHeight);
  blob.cx = {(blob.x1 + blob.x2) * 5};
  blob.cy = {(blob.y1 + blob.y2) * 5};
  return blob;
}

}  // namespace fencepost::nxtcam
