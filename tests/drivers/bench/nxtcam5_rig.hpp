// An NXTCam v5 on the serial line of its camera, after our protocol notes.
#pragma once

#include "drivers/nxtcam/v5_camera.hpp"
#include "host/emulate/models/nxtcam5.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

using emulate::NxtCam5;

struct NxtCam5Rig : CameraRig<> {
  using Link = Cable<NxtCam5>;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit NxtCam5Rig(const fake::SteppedClock& clock, const Damage& damage = {}, const nxtcam::V5Options& options = {})
      : device(clock.now()), link(device, clock, damage), driver(link, options) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[3] == 4; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) link.inject(device.image(moving ? std::vector{blob_of(images)} : scene, now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now), link.forget(); }
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 190);
    const auto y = static_cast<std::int16_t>(image / 190 % 120);
    return {
        3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
        0, {}};
  }
  [[nodiscard]] bool shows(const sensor::BlobFrame& frame, std::int64_t last) const {
    return frame.blobs.size() == 1 && any_of_last(last, [&](auto image) { return frame.blobs[0] == blob_of(image); });
  }
  [[nodiscard]] bool right(const sensor::BlobFrame& frame) const { return shows(frame, latest); }
  [[nodiscard]] bool old(const sensor::BlobFrame& frame) const { return shows(frame, kOldImages); }

  NxtCam5 device;
  Link link;
  nxtcam::V5Camera<Link> driver;
};

}  // namespace fencepost::test
