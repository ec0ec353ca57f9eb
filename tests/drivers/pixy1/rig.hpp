// A Pixy on a serial line, and on USB.
#pragma once

#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy1/usb.hpp"
#include "host/emulate/models/pixy1.hpp"
#include "host/emulate/models/pixy1_usb.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct Pixy1Images : CameraRig<Pixy1Images> {
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 200;
  static constexpr base::Duration kImage = emulate::Pixy1::kImage;

  static sensor::Blob blob_of(std::int64_t image) { return moving_box(image, 250, 150); }
};

struct Pixy1Rig : Pixy1Images {
  using Link = Cable<emulate::Pixy1>;
  static constexpr std::uint32_t kBaud = 115'200;

  explicit Pixy1Rig(const fake::SteppedClock& clock, const Damage& damage = {})
      : link(device, clock, damage), driver(link) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes.size() > 4; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) device.show(seen());
    while (exposing && device.next() && *device.next() <= now) link.inject(device.step(*device.next()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }

  emulate::Pixy1 device{kBaud};
  Link link;
  pixy1::Camera<Link> driver;
};

struct Pixy1UsbRig : Pixy1Images {
  using Link = Cable<emulate::Pixy1Usb>;

  explicit Pixy1UsbRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : device(clock.now()), link(device, clock, damage), driver(link) {
    link.set_bytes_per_ms(1'000);
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes.size() > 4 && bytes[4] == 0x18; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) device.show(seen());
    while (exposing && device.next() <= now) link.inject(device.step(device.next()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }

  emulate::Pixy1Usb device;
  Link link;
  pixy1::UsbCamera<Link> driver;
};

}  // namespace fencepost::test
