// libFuzzer's way in; a short run of it is an ordinary test.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/cognachrome/session.hpp"

namespace {

using namespace fencepost;

void listen(const cognachrome::Format& format, const std::uint8_t* data, std::size_t size) {
  cognachrome::Session session({&format});
  base::Time now{};
  for (std::size_t i = 0; i < size; ++i) {
    now = now + base::milliseconds(1);
    session.step(now);
    if (!session.take(data[i], now)) continue;
    for (const sensor::Blob& blob : session.sample().blobs) {
      if (blob.signature < 1 || blob.signature > 3 || blob.pixels == 0) std::abort();
      if (blob.x1 < 0 || blob.x1 > blob.x2 || blob.x2 >= cognachrome::kWidth) std::abort();
    }
  }
  // Marks and numbers: what is between is a frame, whatever came before; the second of two is given.
  const std::uint8_t mark = format.mark;
  constexpr std::uint8_t kZero = '0';
  bool found = false;
  for (const std::uint8_t byte : {mark, kZero, kZero, mark, kZero, kZero, mark}) {
    if (format.count_digits == 0 && byte == '0') continue;
    found = session.take(byte, now) && session.sample().blobs.empty();
  }
  if (!found) std::abort();
}

}  // namespace

// Whatever arrives: boxes lie in the image, in order, and what comes behind it is found.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  listen(cognachrome::kBinary, data, size);
  listen(cognachrome::kHex, data, size);
  return 0;
}
