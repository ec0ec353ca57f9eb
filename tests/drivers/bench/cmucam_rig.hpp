// A CMUcam on a serial line.
#pragma once

#include "drivers/cmucam/cmucam.hpp"
#include "host/emulate/models/cmucam.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct CmuCamRig : CameraRig<CmuCamRig, emulate::ColouredSpot> {
  static constexpr int kWidth = 176;
  static constexpr int kHeight = 287;
  static constexpr std::size_t kMaxThings = 3;  ///< more are a box with too few pixels
  using Link = Cable<emulate::CmuCamDevice>;
  static constexpr base::Duration kImage = base::milliseconds(60);  ///< 16.7 /s

  CmuCamRig(const fake::SteppedClock& clock, const cmucam::Config& config, emulate::CmuCamModel model,
            const Damage& damage = {})
      : device(model), link(device, clock, damage), driver(link, config) {
    next_image = clock.now() + kImage;
    link.set_bytes_per_ms(1'000);
    // A raw packet, or a letter and numbers.
    link.count_frames(
        [](std::span<const std::uint8_t> bytes) { return bytes[0] == 0xFF || (bytes.size() > 4 && bytes[1] == ' '); });
    link.inject(device.power_up());
  }
  void live(base::Time now) {
    if (!device.starting()) started = now + emulate::CmuCamDevice::kStart;
    if (device.starting() && link.powered() && now >= started) link.inject(device.finish_start());
    if (!expose(now, kImage) || !link.powered()) return;
    link.inject(device.frame(seen()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void switch_off() { link.power(false); }
  void switch_on() {
    link.power(true);
    link.inject(device.power_up());
  }
  void restart(base::Time /*now*/) {
    link.forget();
    switch_on();
  }
  // Red, within the image of every model.
  static emulate::ColouredSpot blob_of(std::int64_t image) {
    const int x = static_cast<int>(image % 60);
    const int y = static_cast<int>(image / 60 % 90);
    return {200, 30, 30, x, y, x + 9, y + 19, 150};
  }
  static bool is(const sensor::BlobFrame& frame, std::int64_t image) {
    if (frame.blobs.size() != 1) return false;
    const emulate::ColouredSpot spot = blob_of(image);
    const sensor::Blob& blob = frame.blobs[0];
    return blob.x1 == spot.x1 && blob.y1 == spot.y1 && blob.x2 == spot.x2 && blob.y2 == spot.y2;
  }

  base::Time started = base::Time{} + emulate::CmuCamDevice::kStart;  ///< when a start is over
  emulate::CmuCamDevice device;
  Link link;
  cmucam::CmuCam<Link> driver;
};

inline cmucam::Config red_window(const cmucam::Dialect& dialect) {
  cmucam::Config config;
  config.dialect = &dialect;
  config.settle = base::milliseconds(500);
  (void)config.windows.push_back({1, 180, 240, 16, 60, 16, 60});
  return config;
}

template <emulate::CmuCamModel Model, const cmucam::Dialect& Dialect>
struct HostileCmuCam : CmuCamRig {
  HostileCmuCam(const fake::SteppedClock& clock, const Damage& damage)
      : CmuCamRig(clock, red_window(Dialect), Model, damage) {}
};

}  // namespace fencepost::test
