// A HuskyLens of either generation on a serial line, through hostile hours.
#include "tests/drivers/bench/hostile_case.hpp"
#include "drivers/huskylens/huskylens.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "host/emulate/models/huskylens2.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {
namespace {

template <class Device, huskylens::Generation Generation>
struct HuskyLensRig : CameraRig<> {
  using Link = Cable<Device>;
  static constexpr bool kTwo = Generation == huskylens::Generation::kTwo;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit HuskyLensRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : device(clock.now()), link(device, clock, damage), driver(link, {.generation = Generation}) {
    link.set_bytes_per_ms(kTwo ? 12 : 1);
    link.count_frames([](std::span<const std::uint8_t> bytes) {
      return bytes.size() > 5 && bytes[kTwo ? 2 : 4] == (kTwo ? 0x42 : 0x29);
    });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) device.show(moving ? std::vector{blob_of(images)} : scene);
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 250);
    const auto y = static_cast<std::int16_t>(image / 250 % 190);
    return {
        3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
        0, {}};
  }
  [[nodiscard]] bool shows(const sensor::BlobFrame& frame, std::int64_t last) const {
    return frame.blobs.size() == 1 && any_of_last(last, [&](auto image) { return frame.blobs[0] == blob_of(image); });
  }
  [[nodiscard]] bool right(const sensor::BlobFrame& frame) const { return shows(frame, latest); }
  [[nodiscard]] bool old(const sensor::BlobFrame& frame) const { return shows(frame, kOldImages); }

  Device device;
  Link link;
  huskylens::Camera<Link> driver;
};

using HuskyLens1 = HuskyLensRig<emulate::HuskyLens, huskylens::Generation::kOne>;
using HuskyLens2 = HuskyLensRig<emulate::HuskyLens2, huskylens::Generation::kTwo>;
const RegisteredCase kHuskyLens1{hostile_case<HuskyLens1, 2>(
    "huskylens:tty", {kSum8, 30'000, base::milliseconds(10'000), base::milliseconds(1'000)})};
// A damaged length makes it wait for up to 255 bytes more: a dozen questions.
const RegisteredCase kHuskyLens2{hostile_case<HuskyLens2, 2>(
    "huskylens2:tty", {kSum8, 30'000, base::milliseconds(30'000), base::milliseconds(1'000)})};

}  // namespace
}  // namespace fencepost::test
