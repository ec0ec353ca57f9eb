// A camera that prints frames, on a serial line through hostile hours.
#include "drivers/serial/pump.hpp"
#include "host/emulate/models/frames.hpp"
#include "host/live/record_sessions.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"

namespace fencepost::test {
namespace {

struct FramesRig : CameraRig<FramesRig> {
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
  using Link = Cable<emulate::FramePrinter>;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit FramesRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : device(true), link(device, clock, damage), driver(link, host::FramesConfig{}) {
    (void)device.power_up(clock.now());
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[0] == '$'; });
  }
  void live(base::Time now) {
    if (!expose(now, kImage)) return;
    sensor::BlobFrame frame;
    for (const sensor::Blob& blob : seen()) (void)frame.blobs.push_back(blob);
    link.inject(device.see(frame, now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { static_cast<void>(device.power_up(now)), link.forget(), link.power(true); }
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 250);
    const auto y = static_cast<std::int16_t>(image / 250 % 190);
    return {
        3,   x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
        900, {}};
  }

  emulate::FramePrinter device;
  Link link;
  serial::Pump<Link, host::FramesSession> driver;
};

constexpr double kFramesSum = 1e-4;
const RegisteredCase kFrames{hostile_case<FramesRig, 2>(
    "frames:tty", {kFramesSum, 30'000, base::milliseconds(10'000), base::milliseconds(2'000)})};

}  // namespace
}  // namespace fencepost::test
