// libFuzzer entry point: the bytes as they are, and as lines whose checksums are right, which a fuzzer would hardly
// guess.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/xbc/decoder.hpp"
#include "hal/base/check.hpp"

namespace fencepost::xbc {
namespace {

void check_frame(const sensor::BlobFrame& frame) {
  for (std::size_t i = 0; i < frame.blobs.size(); ++i) {
    const sensor::Blob& blob = frame.blobs[i];
    FENCEPOST_CHECK(0 <= blob.x1 && blob.x1 <= blob.x2 && blob.x2 < kWidth);
    FENCEPOST_CHECK(0 <= blob.y1 && blob.y1 <= blob.y2 && blob.y2 < kHeight);
    FENCEPOST_CHECK(blob.signature >= 1 && blob.signature <= 3);
  }
}

void read_all(std::string_view bytes) {
  Decoder decoder({1, 2, 3});
  const auto feed = [&](std::string_view some) {
    Event last = Event::kNone;
    for (const char byte : some) {
      last = decoder.feed(static_cast<std::uint8_t>(byte), {});
      if (last == Event::kFrame) check_frame(decoder.frame());
    }
    return last;
  };
  (void)feed(bytes);
  // Whatever came before, a good frame is understood.
  FENCEPOST_CHECK(feed("$F 1234 1*73\n$B 0 0 178 146 600 54 160 131 196 160 0*65\n$E 1234*61\n") == Event::kFrame);
}

std::string resealed(std::string_view bytes) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out;
  unsigned sum = 0;
  for (const char c : bytes) {
    if (c == '$') sum = 0;
    if (c == '\n') {
      out += '*';
      out += kHex[sum / 16];
      out += kHex[sum % 16];
    } else if (c != '$') {
      sum ^= static_cast<unsigned char>(c);
    }
    out += c;
  }
  return out;
}

}  // namespace
}  // namespace fencepost::xbc

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  fencepost::xbc::read_all(bytes);
  fencepost::xbc::read_all(fencepost::xbc::resealed(bytes));
  return 0;
}
