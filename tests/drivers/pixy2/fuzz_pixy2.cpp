// libFuzzer entry point; a short run of it is an ordinary test.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/pixy2/protocol.hpp"
#include "drivers/pixy2/session.hpp"

// Whatever arrives: boxes lie in the image, in order, and bytes behind it are found by the next packet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  wire::Scanner<pixy2::kLongestPacket, pixy2::examine> scanner;
  pixy2::Session session({});
  base::Time now{};
  for (std::size_t i = 0; i < size; ++i) {
    now = now + base::milliseconds(1);
    (void)session.due(now);
    scanner.feed(data[i], now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
      if (message.size() != pixy2::kHeader + message[3]) std::abort();
      session.take(pixy2::packet_of(message), first_byte, now);
    });
    const auto frame = session.take_frame();
    if (!frame) continue;
    for (const sensor::Blob& blob : frame->blobs) {
      if (blob.x1 < 0 || blob.x1 > blob.x2 || blob.x2 >= 316 || blob.y1 < 0 || blob.y1 > blob.y2 || blob.y2 >= 208) {
        std::abort();
      }
    }
  }
  return 0;
}
