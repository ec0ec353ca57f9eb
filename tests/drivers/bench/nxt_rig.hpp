// An NXT brick on USB or a serial line, with an NXTCam on its first port and two motors.
#pragma once

#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "host/emulate/models/nxt.hpp"
#include "tests/drivers/bench/brick_usb.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/create_rig.hpp"
#include "tests/drivers/bench/nxtcam_rig.hpp"

namespace fencepost::test {

/// Telegrams whole, no checksum of their own: USB and Bluetooth have one beneath.
struct UsbBrick {
  static constexpr std::size_t kLengthBytes = 0;
  using Link = BrickUsb;
  UsbBrick(emulate::NxtBrick& device, const fake::SteppedClock& clock, const Damage& damage)
      : link(device, clock, damage), brick(link) {}
  Link link;
  nxt::Brick<Link> brick;
};

/// Behind their lengths, as Bluetooth's serial port carries them.
struct SerialBrick {
  static constexpr std::size_t kLengthBytes = 2;
  using Link = Cable<emulate::NxtBrick>;
  SerialBrick(emulate::NxtBrick& device, const fake::SteppedClock& clock, const Damage& damage)
      : link(device, clock, damage), framed(link), brick(framed) {}
  Link link;
  nxt::FramedLink<Link> framed;
  nxt::Brick<nxt::FramedLink<Link>> brick;
};

// `opcode`: of the reply that is a frame.
template <std::size_t Skip, std::uint8_t Opcode>
bool is_reply(std::span<const std::uint8_t> bytes) {
  return bytes.size() > Skip + 2 && bytes[Skip] == 0x02 && bytes[Skip + 1] == Opcode && bytes[Skip + 2] == 0;
}

struct BrickDevice {
  explicit BrickDevice(const fake::SteppedClock& clock) : device(clock.now()) {}
  emulate::NxtBrick device;
};

/// The NXTCam behind the brick, while the motors are read too.
template <class Wire>
struct NxtCameraRig : NxtCamImages, BrickDevice, Wire {
  using BrickDevice::device;
  using Wire::link;

  explicit NxtCameraRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : NxtCamImages(clock),
        BrickDevice(clock),
        Wire(BrickDevice::device, clock, damage),
        port(this->brick.conversation(), 0),
        driver(port),
        odometry(this->brick.conversation(), {}) {
    device.attach(0, &camera());
    latest = 20;  // through a handful of telegrams, some of them asked for again
    link.count_frames(&is_reply<Wire::kLengthBytes, 0x10>);
  }
  emulate::NxtCam& camera() { return NxtCamImages::device; }
  void live(base::Time now) {
    show_image(now);
    if (!moving) return;
    for (const std::size_t motor : {1U, 2U}) device.turn(motor, static_cast<std::int32_t>(now.raw / 200));
  }
  base::Result<Sample> poll(base::Time now) {
    this->brick.poll(now);
    if (odometry.poll(now)) ++poses;
    return driver.poll(now);
  }
  // The port feeds the camera.
  void restart(base::Time now) { device.restart(now), camera().restart(now), link.forget(); }

  nxt::SensorPort port;
  nxtcam::Camera<nxt::SensorPort> driver;
  nxt::TachoOdometry odometry;
  std::uint64_t poses = 0;
};

/// The brick alone: for clients of its conversation.
template <class Wire>
struct NxtBrickRig : BrickDevice, Wire {
  using Sample = sensor::OdometrySample;

  explicit NxtBrickRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : BrickDevice(clock), Wire(device, clock, damage) {}
  void live(base::Time /*now*/) {}
  base::Result<Sample> poll(base::Time now) {
    this->brick.poll(now);
    return base::Error::kNotReady;
  }
};

/// The motors alone.
template <class Wire>
struct NxtWheelsRig : BrickDevice, Wire, StraightOn {
  using Sample = sensor::OdometrySample;
  using Wire::link;

  explicit NxtWheelsRig(const fake::SteppedClock& clock, const Damage& damage = {},
                        const nxt::TachoOptions& options = {})
      : BrickDevice(clock), Wire(device, clock, damage), driver(this->brick.conversation(), options) {
    // A sample comes with each reading of the left motor.
    link.count_frames([](std::span<const std::uint8_t> bytes) {
      return is_reply<Wire::kLengthBytes, 0x06>(bytes) && bytes[Wire::kLengthBytes + 3] == 1;
    });
  }
  void live(base::Time now) {
    const double seconds = (now - last_moved).to_double();
    last_moved = now;
    left += left_rate * seconds;
    right_wheel += right_rate * seconds;
    device.turn(1, static_cast<std::int32_t>(left));
    device.turn(2, static_cast<std::int32_t>(right_wheel));
  }
  base::Result<Sample> poll(base::Time now) {
    this->brick.poll(now);
    return driver.poll(now);
  }
  void restart(base::Time now) { device.restart(now), link.forget(); }

  nxt::TachoOdometry driver;
  double left_rate = 0;  ///< degrees a second; still in hostile hours, where any turn is damage
  double right_rate = 0;
  double left = 0;
  double right_wheel = 0;
  base::Time last_moved;
};

}  // namespace fencepost::test
