// An NXTCam v4 on an I2C bus, and on its serial line.
#pragma once

#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "host/emulate/models/nxtcam.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/i2c_cable.hpp"

namespace fencepost::test {

struct NxtCamImages : CameraRig<NxtCamImages> {
  static constexpr int kWidth = 176;
  static constexpr int kHeight = 144;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit NxtCamImages(const fake::SteppedClock& clock) : device(clock.now()) {}
  // Columns are reported doubled: even ones.
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(2 * (image % 60));
    const auto y = static_cast<std::int16_t>(image / 60 % 100);
    return {
        3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
        0, {}};
  }
  bool show_image(base::Time now) {
    if (!expose(now, kImage)) return false;
    device.show(seen());
    return true;
  }

  emulate::NxtCam device;
};

struct NxtCamRig : NxtCamImages {
  explicit NxtCamRig(const fake::SteppedClock& clock, const Damage& damage = {}, const nxtcam::Options& options = {})
      : NxtCamImages(clock), link(device, clock, damage), driver(link, options) {
    link.count_frames(0x42);
  }
  void live(base::Time now) { show_image(now); }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now); }

  I2cCable link;
  nxtcam::Camera<I2cCable> driver;
};

struct NxtCamSerialRig : NxtCamImages {
  using Link = Cable<emulate::NxtCam>;

  explicit NxtCamSerialRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : NxtCamImages(clock), link(device, clock, damage), driver(link) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[0] == 0x0A; });
  }
  void live(base::Time now) {
    if (show_image(now)) link.inject(device.packet());
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now), link.forget(); }

  Link link;
  nxtcam::SerialCamera<Link> driver;
};

}  // namespace fencepost::test
