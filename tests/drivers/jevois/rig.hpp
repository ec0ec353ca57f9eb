// A JeVois on a serial line, 30 frames a second.
#pragma once

#include "drivers/jevois/jevois.hpp"
#include "host/emulate/models/jevois.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct JeVoisRig : CameraRig<JeVoisRig> {
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
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
    for (const sensor::Blob& blob : seen()) (void)frame.blobs.push_back(blob);
    link.inject(device.see(frame, now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) {
    link.forget();
    link.power(true);
    (void)device.power_up(now);
  }
  static sensor::Blob blob_of(std::int64_t image) { return moving_box(image, 250, 190); }

  emulate::JeVois device;
  Link link;
  jevois::JeVois<Link> driver;
};

}  // namespace fencepost::test
