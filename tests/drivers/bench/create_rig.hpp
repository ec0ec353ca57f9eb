// A Create on a serial line; a stream frame each 15 ms.
#pragma once

#include <optional>

#include "drivers/create/create.hpp"
#include "host/emulate/models/create.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

/// A wheel base that drives straight on: a sample that turns is wrong.
struct StraightOn {
  [[nodiscard]] bool right(const sensor::OdometrySample& sample) {
    const bool turned = last_heading && *last_heading != sample.heading;
    last_heading = sample.heading;
    return !turned;
  }
  [[nodiscard]] static bool old(const sensor::OdometrySample& /*sample*/) { return false; }

  std::optional<base::Radians> last_heading;
  bool moving = false;
};

template <create::Model Model>
constexpr odometry::WheelBase kWheelsOf =
    Model == create::Model::kCreate1 ? odometry::kCreate1Wheels : odometry::kCreate2Wheels;

struct CreateRig : StraightOn {
  using Sample = sensor::OdometrySample;
  using Link = Cable<emulate::CreateDevice>;
  static constexpr base::Duration kFrame = base::milliseconds(15);

  CreateRig(const fake::SteppedClock& clock, const create::Config& config, emulate::CreateModel model,
            bool header_in_checksum = false, const Damage& damage = {})
      : device(model, header_in_checksum), link(device, clock, damage), driver(link, config) {
    next_frame = clock.now() + kFrame;
    link.set_bytes_per_ms(1'000);
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[0] == 0x13; });
    (void)device.power_up();
  }
  void live(base::Time now) {
    if (now < next_frame) return;
    next_frame = now + kFrame;
    if (!link.powered()) return;
    const int counts = moving ? 5 : 0;
    device.roll(left_a_frame + counts, right_a_frame + counts);
    device.move(mm_a_frame + (moving ? 3 : 0), degrees_a_frame);
    link.inject(device.frame());
  }
  base::Result<Sample> poll(base::Time now) {
    const base::Result<Sample> got = driver.poll(now);
    if (got) last = *got;
    return got;
  }
  void restart(base::Time /*now*/) {
    link.forget();
    link.power(true);
    (void)device.power_up();
  }
  void stand() {
    left_a_frame = right_a_frame = 0;
    mm_a_frame = degrees_a_frame = 0;
  }

  emulate::CreateDevice device;
  Link link;
  create::Create<Link> driver;
  base::Time next_frame;
  int left_a_frame = 0;
  int right_a_frame = 0;
  double mm_a_frame = 0;
  double degrees_a_frame = 0;
  sensor::OdometrySample last{{-1}, {}, {}, {}};
};

template <create::Model Model, emulate::CreateModel Device>
struct HostileCreate : CreateRig {
  HostileCreate(const fake::SteppedClock& clock, const Damage& damage)
      : CreateRig(clock, {Model, create::Mode::kPassive, kWheelsOf<Model>}, Device, false, damage) {}
};

}  // namespace fencepost::test
