// libFuzzer entry point: a frame is reported if and only if the last bytes are one; good frames after anything are
// found.
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "drivers/create/stream_decoder.hpp"
#include "hal/base/check.hpp"

namespace fencepost::create {
namespace {

bool is_frame(const std::deque<std::uint8_t>& last) {
  if (last.size() < 9 || last[0] != 0x13 || last[1] != 6 || last[2] != 43 || last[5] != 44) return false;
  unsigned sum = 0;
  for (std::size_t i = 1; i < 9; ++i) sum += last[i];
  return sum % 256 == 0 || (sum + 0x13) % 256 == 0;
}

void check_bytes(const std::uint8_t* data, std::size_t size) {
  StreamLayout layout;
  FENCEPOST_CHECK(layout.push_back({43, 2}) && layout.push_back({44, 2}));
  StreamDecoder decoder(layout);
  std::deque<std::uint8_t> last;
  for (std::size_t i = 0; i < size; ++i) {
    last.push_back(data[i]);
    if (last.size() > 9) last.pop_front();
    decoder.forget_rule();
    const bool frame = decoder.feed(data[i], {});
    FENCEPOST_CHECK(frame == is_frame(last));
    if (!frame) continue;
    FENCEPOST_CHECK(decoder.value(0) == 256 * last[3] + last[4] && decoder.value(1) == 256 * last[6] + last[7]);
    last.clear();
  }
  constexpr std::array<std::uint8_t, 9> kGood = {0x13, 0x06, 0x2B, 0x03, 0xE8, 0x2C, 0xFF, 0xDC, 0xDD};
  bool found = false;
  for (int twice = 0; twice < 2; ++twice) {
    for (const std::uint8_t byte : kGood) found = decoder.feed(byte, {});
  }
  FENCEPOST_CHECK(found);
}

}  // namespace
}  // namespace fencepost::create

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fencepost::create::check_bytes(data, size);
  return 0;
}
