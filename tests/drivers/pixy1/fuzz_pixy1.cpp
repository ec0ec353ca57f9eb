// libFuzzer's way in; a short run of it is an ordinary test.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/pixy1/pixy1.hpp"

namespace {

bool possible(const fencepost::sensor::BlobFrame& frame) {
  namespace pixy1 = fencepost::pixy1;
  for (const fencepost::sensor::Blob& blob : frame.blobs) {
    if (blob.signature == 0 || blob.x1 < 0 || blob.x1 > blob.x2 || blob.x2 >= pixy1::kWidth) return false;
    if (blob.y1 < 0 || blob.y1 > blob.y2 || blob.y2 >= pixy1::kHeight) return false;
  }
  return true;
}

// Marks that end what came before, and an image of one block: 40 x 30 around (160, 100).
constexpr std::uint8_t kImage[] = {0,    0,    0,    0,    0, 0,    0,    0,    0,    0,    0,    0,
                                   0,    0,    0,    0,    0, 0x55, 0xAA, 0x55, 0xAA, 0x4B, 0x01, 0x01,
                                   0x00, 0xA0, 0x00, 0x64, 0, 0x28, 0,    0x1E, 0,    0,    0};

}  // namespace

// Whatever arrives: boxes lie in the image, in order, and what comes behind it is found.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  pixy1::Session session({});
  base::Time now{};
  for (std::size_t i = 0; i < size; ++i) {
    now = now + base::milliseconds(1);
    session.step(now);
    if (session.take(data[i], now) && !possible(session.sample())) std::abort();
  }
  bool found = false;
  for (const std::uint8_t byte : kImage) {
    now = now + base::milliseconds(1);
    if (session.take(byte, now)) found = session.sample().blobs.size() == 1 && session.sample().blobs[0].x1 == 140;
  }
  if (!found) std::abort();
  return 0;
}
