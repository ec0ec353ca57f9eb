// A Pixy on a serial line, and on USB.
#pragma once

#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy1/usb.hpp"
#include "host/emulate/models/pixy1.hpp"
#include "host/emulate/models/pixy1_usb.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

struct Pixy1Images : CameraRig<> {
  static constexpr base::Duration kImage = emulate::Pixy1::kImage;

  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 250);
    const auto y = static_cast<std::int16_t>(image / 250 % 150);
    return {
        3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
        0, {}};
  }
  [[nodiscard]] bool shows(const sensor::BlobFrame& frame, std::int64_t last) const {
    return frame.blobs.size() == 1 && any_of_last(last, [&](auto image) { return frame.blobs[0] == blob_of(image); });
  }
  [[nodiscard]] bool right(const sensor::BlobFrame& frame) const { return shows(frame, latest); }
  [[nodiscard]] bool old(const sensor::BlobFrame& frame) const { return shows(frame, kOldImages); }
};

struct Pixy1Rig : Pixy1Images {
  using Link = Cable<emulate::Pixy1>;
  static constexpr std::uint32_t kBaud = 115'200;

  explicit Pixy1Rig(const fake::SteppedClock& clock, const Damage& damage = {})
      : link(device, clock, damage), driver(link) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes.size() > 4; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) device.show(moving ? std::vector{blob_of(images)} : scene);
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
    if (expose(now, kImage)) device.show(moving ? std::vector{blob_of(images)} : scene);
    while (exposing && device.next() <= now) link.inject(device.step(device.next()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(); }

  emulate::Pixy1Usb device;
  Link link;
  pixy1::UsbCamera<Link> driver;
};

}  // namespace fencepost::test
