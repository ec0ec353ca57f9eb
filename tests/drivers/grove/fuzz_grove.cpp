// libFuzzer entry point: whatever arrives, boxes lie in the picture; after it, good frames are understood.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/grove/grove.hpp"
#include "hal/base/check.hpp"

namespace fencepost::grove {
namespace {

void check_frame(const sensor::BlobFrame& frame) {
  for (const sensor::Blob& blob : frame.blobs) {
    FENCEPOST_CHECK(0 <= blob.x1 && blob.x1 <= blob.x2 && blob.x2 < kSide);
    FENCEPOST_CHECK(0 <= blob.y1 && blob.y1 <= blob.y2 && blob.y2 < kSide);
    FENCEPOST_CHECK(0 <= blob.cx.raw && blob.cx.raw <= 10 * (kSide - 1));
    FENCEPOST_CHECK(0 <= blob.cy.raw && blob.cy.raw <= 10 * (kSide - 1));
    FENCEPOST_CHECK(blob.signature >= 1);
  }
}

// Bytes choose among parts of messages, or stand for themselves: few random bytes are JSON.
constexpr std::string_view kParts[] = {"\r{\"type\": 1, \"name\": \"INVOKE\", \"code\": 0, \"data\": {",
                                       "\"boxes\": [",
                                       "[120, 90, 40, 30, 80, 1]",
                                       "[-1, 5000, 0, 9",
                                       ", ",
                                       "]",
                                       "}",
                                       "}}\n",
                                       "\"resolution\": [640, 480]",
                                       "\"resolution\": [0, 1]",
                                       "\"image\": \"a\\\"b",
                                       "\"points\": [[[1, 2.5]]]"};

}  // namespace
}  // namespace fencepost::grove

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using fencepost::grove::Decoder;
  using fencepost::grove::Event;
  Decoder decoder;
  const auto feed = [&decoder](std::uint8_t byte) {
    const Event event = decoder.feed(byte, {});
    if (event == Event::kFrame) fencepost::grove::check_frame(decoder.frame());
    return event;
  };
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] < std::size(fencepost::grove::kParts)) {
      for (const char c : fencepost::grove::kParts[data[i]]) (void)feed(static_cast<std::uint8_t>(c));
    } else {
      (void)feed(data[i]);
    }
  }
  bool found = false;
  for (const char c : std::string_view("\n\r{\"type\": 1, \"name\": \"INVOKE\", \"code\": 0, \"data\": {\"boxes\": "
                                       "[[87, 83, 77, 65, 70, 0]]}}\n")) {
    found = feed(static_cast<std::uint8_t>(c)) == Event::kFrame || found;
  }
  FENCEPOST_CHECK(found && decoder.frame().blobs.size() == 1);
  return 0;
}
