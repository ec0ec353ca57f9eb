// A JeVois on a serial line, 30 frames a second.
#pragma once

#include "drivers/jevois/jevois.hpp"
#include "host/emulate/models/jevois.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct JeVoisRig : CameraRig<std::vector<sensor::Blob>> {
  using Link = Cable<emulate::JeVois>;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit JeVoisRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : link(device, clock, damage), driver(link, jevois::Config{}) {
    (void)device.power_up(clock.now());
    next_image = clock.now() + kImage;
    link.set_bytes_per_ms(12);
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes.size() > 20; });
  }
  void live(base::Time now) {
    if (!expose(now, kImage)) return;
    sensor::BlobFrame frame;
    for (const sensor::Blob& blob : moving ? std::vector{blob_of(images)} : scene) (void)frame.blobs.push_back(blob);
    link.inject(device.see(frame, now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) {
    link.forget();
    link.power(true);
    (void)device.power_up(now);
  }
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

  emulate::JeVois device;
  Link link;
  jevois::JeVois<Link> driver;
};

}  // namespace fencepost::test
