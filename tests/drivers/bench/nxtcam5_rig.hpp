// An NXTCam v5 on the serial line of its camera, after our protocol notes.
#pragma once

#include "drivers/nxtcam/v5_camera.hpp"
#include "host/emulate/models/nxtcam5.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

using emulate::NxtCam5;

struct NxtCam5Rig : CameraRig<NxtCam5Rig> {
  static constexpr int kWidth = 240;
  static constexpr int kHeight = 160;
  using Link = Cable<NxtCam5>;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit NxtCam5Rig(const fake::SteppedClock& clock, const Damage& damage = {}, const nxtcam::V5Options& options = {})
      : device(clock.now()), link(device, clock, damage), driver(link, options) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[3] == 4; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) link.inject(device.image(seen(), now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now), link.forget(); }
  static sensor::Blob blob_of(std::int64_t image) { return moving_box(image, 190, 120); }

  NxtCam5 device;
  Link link;
  nxtcam::V5Camera<Link> driver;
};

}  // namespace fencepost::test
