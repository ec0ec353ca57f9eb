// libFuzzer entry point; a short run of it is an ordinary test.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/nxtcam/serial.hpp"
#include "drivers/nxtcam/session.hpp"
#include "drivers/nxtcam/v5_session.hpp"

namespace {

using fencepost::sensor::Blob;

void check(const Blob& blob, std::int16_t width, std::int16_t height) {
  if (blob.x1 < 0 || blob.x1 > blob.x2 || blob.x2 >= width || blob.y1 < 0 || blob.y1 > blob.y2 || blob.y2 >= height) {
    std::abort();
  }
}

// A v5's whole conversation: bytes, and pauses where they are small.
void converse_with_v5(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  nxtcam::V5Session session({.silence_is_empty = size % 2 != 0});
  base::Time now{};
  std::uint32_t given = 0;
  std::optional<base::Time> last;
  for (std::size_t i = 0; i < size; ++i) {
    now = now + base::milliseconds(data[i] < 16 ? 10 * data[i] : 0);
    session.take(data[i], now);
    session.step(now);
    session.outbox().sent(session.outbox().waiting().size());
    const auto frame = session.take_frame();
    if (!frame) continue;
    if (frame->frame < given || (last && frame->t <= *last)) std::abort();
    given = frame->frame + 1;
    last = frame->t;
    for (const Blob& blob : frame->blobs) check(blob, nxtcam::kV5Width, nxtcam::kV5Height);
  }
}

}  // namespace

// The same bytes as a serial stream of both kinds, as a conversation with a v5, and as answers to I2C reads.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  using namespace fencepost::nxtcam;
  converse_with_v5(data, size);
  wire::Scanner<kLongestTracking, examine_avrcam> avrcam;
  wire::Scanner<kLongestV5, examine_v5> v5;
  for (std::size_t i = 0; i < size; ++i) {
    avrcam.feed(data[i], {}, [](std::span<const std::uint8_t> message, base::Time) {
      if (const auto frame = tracking_in(message)) {
        for (const Blob& blob : frame->blobs) check(blob, kWidth, kHeight);
      } else if (line_in(message).empty()) {
        std::abort();
      }
    });
    v5.feed(data[i], {}, [](std::span<const std::uint8_t> message, base::Time) {
      if (const auto blob = v5_blob_in(message)) check(blob->blob, kV5Width, kV5Height);
    });
  }
  Session session({.check_colour_map = false});
  base::Time now{};
  for (std::size_t at = 0; at < size;) {
    now = now + base::milliseconds(40);
    const auto transfer = session.due(now);
    if (!transfer) continue;
    const std::size_t count = std::min(transfer->expected, size - at);
    session.take({data + at, count}, now);
    at += count == 0 ? 1 : count;
    if (const auto frame = session.take_frame()) {
      for (const Blob& blob : frame->blobs) check(blob, kWidth, kHeight);
    }
  }
  return 0;
}
