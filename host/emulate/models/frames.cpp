#include "host/emulate/models/frames.hpp"

#include <string_view>

#include "hal/base/crc16.hpp"

namespace fencepost::emulate {
namespace {

std::string tenths(std::int32_t raw) { return std::to_string(raw / 10) + "." + std::to_string(raw % 10); }

std::string seconds(base::Duration time) {
  const std::string parts = std::to_string(time.raw % base::Duration::kPerUnit + base::Duration::kPerUnit);
  return std::to_string(time.raw / base::Duration::kPerUnit) + "." + parts.substr(1);
}

std::string sealed(const std::string& body) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const unsigned crc = base::crc16(body);
  std::string line = "$" + body + "*";
  for (const unsigned shift : {12U, 8U, 4U, 0U}) line += kHex[crc >> shift & 0xFU];
  return line + "\r\n";
}

}  // namespace

Bytes FramePrinter::power_up(base::Time now) {
  power_on_ = now;
  number_ = 0;
  return {};
}

Bytes FramePrinter::see(const sensor::BlobFrame& frame, base::Time now) {
  if (now - power_on_ < kStart) return {};
  std::string body =
      "FPFRM," + seconds(now - power_on_) + "," + std::to_string(++number_) + "," + std::to_string(frame.blobs.size());
  for (const sensor::Blob& blob : frame.blobs) {
    const std::int32_t x = areas_ ? blob.cx.raw : 5 * (blob.x1 + blob.x2);
    const std::int32_t y = areas_ ? blob.cy.raw : 5 * (blob.y1 + blob.y2);
    body += "," + std::to_string(blob.signature);
    for (const int edge : {blob.x1, blob.y1, blob.x2, blob.y2}) body += "," + std::to_string(edge);
    body += "," + tenths(x) + "," + tenths(y) + "," + std::to_string(areas_ ? blob.pixels : 0) + ",";
  }
  const std::string line = sealed(body);
  return {line.begin(), line.end()};
}

}  // namespace fencepost::emulate
