// libFuzzer entry point: whatever arrives, boxes lie in the picture; after it, good frames are understood.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/jevois/decoder.hpp"
#include "hal/base/check.hpp"

namespace fencepost::jevois {
namespace {

void check_frame(const sensor::BlobFrame& frame) {
  for (const sensor::Blob& blob : frame.blobs) {
    FENCEPOST_CHECK(0 <= blob.x1 && blob.x1 <= blob.x2 && blob.x2 < kWidth);
    FENCEPOST_CHECK(0 <= blob.y1 && blob.y1 <= blob.y2 && blob.y2 < kHeight);
    FENCEPOST_CHECK(0 <= blob.cx.raw && blob.cx.raw <= 10 * (kWidth - 1));
    FENCEPOST_CHECK(0 <= blob.cy.raw && blob.cy.raw <= 10 * (kHeight - 1));
    FENCEPOST_CHECK(blob.signature >= 1);
  }
}

}  // namespace
}  // namespace fencepost::jevois

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using fencepost::jevois::Decoder;
  using fencepost::jevois::Event;
  Decoder decoder(fencepost::jevois::Names{});
  const auto feed = [&decoder](std::uint8_t byte) {
    const Event event = decoder.feed(byte, {});
    if (event == Event::kFrame) fencepost::jevois::check_frame(decoder.frame());
    return event;
  };
  for (std::size_t i = 0; i < size; ++i) (void)feed(data[i]);
  bool found = false;
  for (const char c : std::string_view("\nMARK START\r\nN2 blob2 250 -188 400 300\r\nMARK STOP\r\n")) {
    found = feed(static_cast<std::uint8_t>(c)) == Event::kFrame || found;
  }
  FENCEPOST_CHECK(found && decoder.frame().blobs.size() == 1);
  return 0;
}
