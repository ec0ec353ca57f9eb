// A Cognachrome on a serial line through hostile hours.
#include "drivers/cognachrome/cognachrome.hpp"
#include "host/emulate/models/cognachrome.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"

namespace fencepost::test {
namespace {

struct CognachromeRig : CameraRig<CognachromeRig> {
  static constexpr int kWidth = 250;
  static constexpr int kHeight = 200;
  static constexpr std::size_t kMaxThings = 8;  ///< of a field, at 38400 baud
  using Link = Cable<emulate::Cognachrome>;
  static constexpr std::uint32_t kBaud = 38'400;

  explicit CognachromeRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : link(device, clock, damage), driver(link, cognachrome::Config{}) {
    link.set_bytes_per_ms(4);
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[0] == 0xFF; });
  }
  void live(base::Time now) {
    if (expose(now, emulate::Cognachrome::kField)) device.show(seen());
    while (exposing && *device.next() <= now) link.inject(device.step(*device.next()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }
  // 41 columns of 40 rows.
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 200);
    const auto y = static_cast<std::int16_t>(image / 200 % 150);
    return {3, x, y, static_cast<std::int16_t>(x + 40), static_cast<std::int16_t>(y + 39), {}, {}, 0, {}};
  }
  static bool is(const sensor::BlobFrame& frame, std::int64_t image) {
    if (frame.blobs.size() != 1) return false;
    const sensor::Blob shown = blob_of(image);
    const sensor::Blob& blob = frame.blobs[0];
    return blob.signature == 3 && blob.pixels == 1'640 && blob.cx.raw == 10 * (shown.x1 + 20) &&
           blob.cy.raw == 10 * (shown.y1 + 20);
  }

  emulate::Cognachrome device{emulate::Cognachrome::Preset::kVision, kBaud};
  Link link;
  cognachrome::Camera<Link> driver;
};

// There is no checksum at all.
constexpr double kCognachromeSum = 0.1;
// A start is five prompts, begun anew when a byte of theirs was damaged.
const RegisteredCase kCognachrome{hostile_case<CognachromeRig, 2>(
    "cognachrome:tty", {kCognachromeSum, 100'000, base::milliseconds(30'000), base::milliseconds(1'000)})};

}  // namespace
}  // namespace fencepost::test
