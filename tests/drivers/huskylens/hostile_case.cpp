// A HuskyLens of either generation on a serial line, through hostile hours.
#include "drivers/huskylens/huskylens.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "host/emulate/models/huskylens2.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"

namespace fencepost::test {
namespace {

template <class Device, huskylens::Generation Generation>
struct HuskyLensRig : CameraRig<HuskyLensRig<Device, Generation>> {
  static constexpr int kWidth = Generation == huskylens::Generation::kTwo ? 640 : 320;
  static constexpr int kHeight = Generation == huskylens::Generation::kTwo ? 480 : 240;
  using Sample = sensor::BlobFrame;
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
    if (this->expose(now, kImage)) device.show(this->seen());
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }
  static sensor::Blob blob_of(std::int64_t image) { return moving_box(image, 250, 190); }

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
