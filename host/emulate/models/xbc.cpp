#include "host/emulate/models/xbc.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>

namespace fencepost::emulate {
namespace {

std::string with_xor(const std::string& body) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return "$" + body + "*" + kHex[sum / 16] + kHex[sum % 16] + "\n";
}

std::string numbers(std::initializer_list<std::int64_t> values) {
  std::string text;
  for (const std::int64_t value : values) text += " " + std::to_string(value);
  return text;
}

}  // namespace

int xbc_confidence(const XbcBlob& blob) {
  return 100 * blob.size / ((blob.right - blob.left + 1) * (blob.bottom - blob.top + 1));
}

std::string XbcDevice::power_up() {
  number_ = 1;
  return {};
}

std::string XbcDevice::feed(std::string_view bytes) {
  std::string replies;
  for (auto questions = std::count(bytes.begin(), bytes.end(), '?'); questions > 0; --questions) {
    replies += with_xor("V XBCL 1");
  }
  return replies;
}

std::string XbcDevice::frame(std::span<const XbcBlob> blobs) {
  std::string lines = with_xor("F" + numbers({number_, static_cast<std::int64_t>(blobs.size())}));
  for (const XbcBlob& blob : blobs) {
    lines += with_xor("B" + numbers({blob.channel, blob.index, blob.x, blob.y, blob.size, xbc_confidence(blob),
                                     blob.left, blob.top, blob.right, blob.bottom, blob.angle}));
  }
  lines += with_xor("E" + numbers({number_}));
  ++number_;
  return lines;
}

}  // namespace fencepost::emulate
