// A Pixy2 on a serial line, and on USB.
#pragma once

#include "drivers/pixy2/camera.hpp"
#include "drivers/pixy2/chirp_link.hpp"
#include "host/emulate/models/pixy2.hpp"
#include "host/emulate/models/pixy2_usb.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct Pixy2Images : CameraRig<Pixy2Images> {
  static constexpr int kWidth = 316;
  static constexpr int kHeight = 208;
  static constexpr base::Duration kImage = base::milliseconds(16);

  explicit Pixy2Images(const fake::SteppedClock& clock) : device(clock.now()) {}
  void live(base::Time now) {
    if (expose(now, kImage)) device.show(seen());
  }
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 200);
    const auto y = static_cast<std::int16_t>(image / 200 % 150);
    return {
        3, x, y, static_cast<std::int16_t>(x + 40), static_cast<std::int16_t>(y + 30), {10 * x + 200}, {10 * y + 150},
        0, {}};
  }
  /// With an id besides, of the camera's tracker.
  static bool is(const sensor::BlobFrame& frame, std::int64_t image) {
    if (frame.blobs.size() != 1 || frame.blobs[0].track == 0) return false;
    sensor::Blob blob = frame.blobs[0];
    blob.track = 0;
    return blob == blob_of(image);
  }

  emulate::Pixy2 device;
};

struct Pixy2Rig : Pixy2Images {
  using Link = Cable<emulate::Pixy2>;

  explicit Pixy2Rig(const fake::SteppedClock& clock, const Damage& damage = {}, const pixy2::Options& options = {})
      : Pixy2Images(clock), link(device, clock, damage), driver(link, options) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[2] == 0x21; });
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now), link.forget(); }

  Link link;
  pixy2::Camera<Link> driver;
};

struct Pixy2UsbRig : Pixy2Images {
  using Link = Cable<emulate::Pixy2Usb>;

  explicit Pixy2UsbRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : Pixy2Images(clock), usb(device), link(usb, clock, damage), chirp(link), driver(chirp) {
    link.set_bytes_per_ms(1'000);
    // Behind header and result: the type of the packet in it.
    link.count_frames(
        [](std::span<const std::uint8_t> bytes) { return bytes.size() > 17 && bytes[4] == 0x40 && bytes[17] == 0x21; });
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { usb.restart(now), link.forget(); }

  emulate::Pixy2Usb usb;
  Link link;
  pixy2::ChirpLink<Link> chirp;
  pixy2::Camera<pixy2::ChirpLink<Link>> driver;
};

}  // namespace fencepost::test
