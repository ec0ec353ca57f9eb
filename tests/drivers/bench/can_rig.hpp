// Two wheel controllers on a CAN bus.
#pragma once

#include "drivers/can_wheels/layouts.hpp"
#include "drivers/can_wheels/odometry.hpp"
#include "host/emulate/models/can_wheels.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/can_cable.hpp"
#include "tests/drivers/bench/create_rig.hpp"

namespace fencepost::test {

struct CanRig : StraightOn {
  using Sample = sensor::OdometrySample;

  explicit CanRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : device(emulate::CanWheels::Kind::kTalonSrx, clock.now()), link(damage), driver(link, mapping()) {}
  // 1000 counts a second: 76.7 mm/s, straight on.
  void live(base::Time now) {
    const auto count = static_cast<std::int32_t>(moving ? now.raw / 10 : 0);
    device.turn(count, count, 100, 100);
    for (const bus::CanFrame& frame : device.frames(now)) link.put(frame);
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now); }
  static can_wheels::Mapping mapping() {
    can_wheels::Mapping mapping;
    mapping.left = can_wheels::talon_srx_position(3);
    mapping.right = can_wheels::talon_srx_position(4);
    mapping.wheels = odometry::make_wheel_base({100, 4'096}, 500, 24);
    return mapping;
  }
  // Turned by less than a frame's worth of counts, as one wheel is heard before the other.
  [[nodiscard]] static bool right(const sensor::OdometrySample& sample) {
    return sample.heading.raw < 200 && sample.heading.raw > -200;
  }

  emulate::CanWheels device;
  CanCable link;
  can_wheels::Odometry<CanCable> driver;
};

}  // namespace fencepost::test
