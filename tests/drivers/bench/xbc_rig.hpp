// An XBC on a serial line, 15 frames a second.
#pragma once

#include "drivers/xbc/xbc.hpp"
#include "host/emulate/models/xbc.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct XbcRig : CameraRig<XbcRig, emulate::XbcBlob> {
  static constexpr int kWidth = 356;
  static constexpr int kHeight = 291;
  using Link = Cable<emulate::XbcDevice>;
  static constexpr base::Duration kImage = base::milliseconds(65);

  explicit XbcRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : link(device, clock, damage), driver(link, xbc::Config{}) {
    next_image = clock.now() + kImage;
    link.set_bytes_per_ms(1'000);
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[0] == '$' && bytes[1] == 'F'; });
  }
  void live(base::Time now) {
    if (!expose(now, kImage)) return;
    ++sent;
    link.inject(device.frame(seen()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time /*now*/) {
    link.forget();
    link.power(true);
    link.inject(device.power_up());
  }
  static emulate::XbcBlob blob_of(std::int64_t image) {
    const int x = static_cast<int>(image % 300);
    const int y = static_cast<int>(image / 300 % 200);
    return {0, 0, x + 18, y + 15, 600, x, y, x + 36, y + 29, 0};
  }
  static bool is(const sensor::BlobFrame& frame, std::int64_t image) {
    if (frame.blobs.size() != 1) return false;
    const emulate::XbcBlob shown = blob_of(image);
    const sensor::Blob& blob = frame.blobs[0];
    return blob.x1 == shown.left && blob.y1 == shown.top && blob.x2 == shown.right && blob.y2 == shown.bottom &&
           blob.pixels == 600;
  }

  emulate::XbcDevice device;
  Link link;
  xbc::Xbc<Link> driver;
  std::uint32_t sent = 0;
};

}  // namespace fencepost::test
