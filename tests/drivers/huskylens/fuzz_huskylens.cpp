// libFuzzer's way in; a short run of it is an ordinary test.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/huskylens/huskylens.hpp"

// Whatever arrives: boxes lie in the image, in order, and no question waits for ever.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  huskylens::Options options;
  if (size > 0 && data[0] % 2 == 1) options.generation = huskylens::Generation::kTwo;
  const bool two = options.generation == huskylens::Generation::kTwo;
  huskylens::Session session(options);
  base::Time now{};
  for (std::size_t i = 0; i < size; ++i) {
    now = now + base::milliseconds(1);
    session.step(now);
    session.outbox().clear();
    session.take(data[i], now);
    const auto frame = session.take_frame();
    if (!frame) continue;
    for (const sensor::Blob& blob : frame->blobs) {
      if (blob.signature == 0 || blob.x1 < 0 || blob.x1 > blob.x2 || blob.x2 >= (two ? 640 : 320)) std::abort();
      if (blob.y1 < 0 || blob.y1 > blob.y2 || blob.y2 >= (two ? 480 : 240)) std::abort();
    }
  }
  const std::uint32_t timeouts = session.counts().timeouts;
  for (int i = 0; i < 200; ++i) {
    now = now + base::milliseconds(10);
    session.step(now);
  }
  if (session.counts().timeouts == timeouts) std::abort();
  return 0;
}
