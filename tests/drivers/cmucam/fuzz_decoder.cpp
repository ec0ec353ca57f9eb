// libFuzzer entry point: the decoder, and what becomes of its packets. The ordinary tests call it too.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/cmucam/decoder.hpp"
#include "drivers/cmucam/measure.hpp"
#include "hal/base/check.hpp"

namespace fencepost::cmucam {
namespace {

void check_blob(const sensor::Blob& blob, const Dialect& dialect) {
  FENCEPOST_CHECK(0 <= blob.x1 && blob.x1 <= blob.x2 && blob.x2 < dialect.width);
  FENCEPOST_CHECK(0 <= blob.y1 && blob.y1 <= blob.y2 && blob.y2 < dialect.height);
  FENCEPOST_CHECK(10 * blob.x1 <= blob.cx.raw && blob.cx.raw <= 10 * blob.x2);
  FENCEPOST_CHECK(10 * blob.y1 <= blob.cy.raw && blob.cy.raw <= 10 * blob.y2);
  FENCEPOST_CHECK(blob.pixels < 1U << 16);
}

}  // namespace
}  // namespace fencepost::cmucam

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost::cmucam;
  const std::array<const Dialect*, 7> dialects = {&kCmuCam1, &kCmuCam2,     &kCmuCam2High, &kCmuCam2Ov7620,
                                                  &kCmuCam3, &kCmuCam3High, &kCmuCam4};
  Decoder decoder;
  for (std::size_t i = 0; i < size; ++i) {
    const fencepost::base::Time now{static_cast<std::int64_t>(i)};
    if (decoder.feed(data[i], now) != Event::kPacket) continue;
    FENCEPOST_CHECK(decoder.packet().t <= now && decoder.packet().count <= Packet::kMaxFields);
    for (const Dialect* dialect : dialects) {
      if (const auto blob = to_blob(decoder.packet(), *dialect, 1)) check_blob(*blob, *dialect);
    }
  }
  // Whatever came before, a good packet after a line end is understood.
  fencepost::cmucam::Event last = Event::kNone;
  for (const char c : {'\r', '\r', '\xFF', 'C', '\1', '\1', '\2', '\2', '\1', '\x40'}) {
    last = decoder.feed(static_cast<std::uint8_t>(c), {});
  }
  FENCEPOST_CHECK(last == Event::kPacket && decoder.packet().letter == 'C');
  return 0;
}
