// A Grove Vision AI V2 on its serial line and on I2C, through hostile hours.
#include "drivers/grove/grove.hpp"
#include "host/emulate/models/grove.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/bench/i2c_cable.hpp"

namespace fencepost::test {
namespace {

struct GroveImages : CameraRig<GroveImages> {
  static constexpr int kWidth = grove::kSide;
  static constexpr int kHeight = grove::kSide;
  static constexpr base::Duration kImage = base::milliseconds(66);

  explicit GroveImages(const fake::SteppedClock& clock) : device(kWidth, kHeight, clock.now()) {}
  // Its middle is said in whole pixels: even sizes.
  static sensor::Blob blob_of(std::int64_t image) {
    sensor::Blob blob = moving_box(image, 190, 190);
    --blob.y2;
    blob.cy.raw -= 5;
    return blob;
  }
  [[nodiscard]] emulate::Bytes result(base::Time now) {
    sensor::BlobFrame frame;
    for (const sensor::Blob& blob : seen()) (void)frame.blobs.push_back(blob);
    return device.see(frame, now);
  }

  emulate::Grove device;
};

struct GroveRig : GroveImages {
  using Link = Cable<emulate::Grove>;

  explicit GroveRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : GroveImages(clock), link(device, clock, damage), driver(link) {
    link.set_bytes_per_ms(92);
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes.size() > 10 && bytes[10] == '1'; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) link.inject(result(now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }

  Link link;
  grove::Camera<Link> driver;
};

// Nothing is sealed: of a frame's 140 bytes a dozen are a box's digits, and one in 100 bytes is damaged.
const RegisteredCase kGrove{
    hostile_case<GroveRig, 2>("grove:tty", {kNoSum, 10'000, base::milliseconds(10'000), base::milliseconds(1'000)})};

}  // namespace
}  // namespace fencepost::test
