// libFuzzer entry point; a short run of it is an ordinary test.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/can_wheels/layouts.hpp"
#include "drivers/can_wheels/wheels.hpp"

// Twelve bytes a frame: identifier's choice, length, pause, data.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  using namespace fencepost::can_wheels;
  Mapping counts;
  counts.left = talon_srx_position(3);
  counts.right = talon_srx_position(4);
  counts.wheels = odometry::make_wheel_base({100, 4'096}, 500, 24);
  Mapping speeds = counts;
  speeds.left = talon_srx_velocity(3);
  speeds.right = talon_srx_velocity(4);
  speeds.quantity = Quantity::kVelocities;
  Wheels by_counts(counts);
  Wheels by_speeds(speeds);
  base::Time now{};
  for (std::size_t at = 0; at + 12 <= size; at += 12) {
    bus::CanFrame frame;
    frame.id = counts.left.id + data[at] % 3U;
    frame.extended = true;
    frame.length = static_cast<std::uint8_t>(data[at + 1] % 9U);
    now = now + base::milliseconds(data[at + 2]);
    std::copy_n(data + at + 4, 8, frame.data.begin());
    for (Wheels* wheels : {&by_counts, &by_speeds}) {
      const auto sample = wheels->take(frame, now);
      if (sample && (sample->heading.raw > 31'416 || sample->heading.raw < -31'416 || sample->t > now)) std::abort();
    }
  }
  return 0;
}
