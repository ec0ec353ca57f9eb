// One hour on a bad serial line: 1 % of the bytes damaged, both ways, and every 20 s a stall, a reboot or an unplug; an
// NXTCam and two motors behind the brick. Telegrams have no checksum: damage within the possible goes through, and is
// counted here.
#include <gtest/gtest.h>

#include <random>

#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "host/emulate/nxt.hpp"
#include "host/emulate/nxtcam.hpp"
#include "tests/drivers/emulated_link.hpp"
#include "tests/drivers/faults.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fencepost::nxt {
namespace {

using test::Faults;
using Link = test::EmulatedLink<emulate::NxtBrick>;

const sensor::Blob kRed{2, 60, 40, 81, 70, {705}, {550}, 0, {}};

TEST(NxtHostile, NeverHangs) {
  constexpr std::int64_t kStep = 2;
  fake::SteppedClock clock;
  emulate::NxtCam camera_device{base::Time{}};
  emulate::NxtBrick device{base::Time{}};
  device.attach(0, &camera_device);
  Link link{device, clock, 0.01, 9};
  FramedLink<Link> framed(link);
  Brick<FramedLink<Link>> brick(framed);
  SensorPort port(brick.conversation(), 0);
  nxtcam::Camera<SensorPort> camera(port);
  TachoOdometry odometry(brick.conversation(), {});
  Faults faults(6);
  std::uint32_t samples = 0;
  std::uint32_t frames = 0;
  std::uint32_t wrong = 0;
  base::Time last_sample{};
  base::Time last_frame{};
  base::Duration sample_gap{};
  base::Duration frame_gap{};
  std::size_t longest_queue = 0;
  for (std::int64_t ms = 0; ms < 3'600'000; ms += kStep) {
    clock.advance(base::milliseconds(kStep));
    const base::Time now = clock.now();
    switch (faults.begin(now)) {
      case Faults::Kind::kNone: break;
      case Faults::Kind::kStall: link.stall(); break;
      case Faults::Kind::kReboot: device.restart(now), link.forget(); break;
      case Faults::Kind::kUnplug: link.unplug(); break;
    }
    if (faults.over(now)) link.resume(), link.replug();
    if (ms % 34 == 0) camera_device.show({kRed});
    device.turn(1, static_cast<std::int32_t>(ms / 20));
    device.turn(2, static_cast<std::int32_t>(ms / 20));
    longest_queue = std::max(longest_queue, link.waiting());
    if (faults.quiet(now) > base::milliseconds(6'000)) {
      sample_gap = std::max(sample_gap, now - last_sample);
      frame_gap = std::max(frame_gap, now - std::max(last_frame, last_sample - base::milliseconds(60'000)));
    }
    brick.poll(now);
    if (odometry.poll(now)) ++samples, last_sample = now;
    const auto frame = camera.poll(now);
    if (!frame) continue;
    ++frames;
    last_frame = now;
    if (frame->blobs.size() != 1 || !(frame->blobs[0] == kRed)) ++wrong;
  }
  const Counters& counters = brick.conversation().counters();
  std::printf(
      "samples %u, frames %u, %u of them wrong; %u telegrams, %u foreign, %u malformed, %u timeouts, %u failed; "
      "%u bytes damaged, %u faults; longest gaps %.1f s and %.1f s\n",
      samples, frames, wrong, counters.telegrams, counters.foreign, counters.malformed, counters.timeouts,
      counters.failed, link.corruptor().corrupted(), faults.count(), static_cast<double>(sample_gap.raw) * 1e-4,
      static_cast<double>(frame_gap.raw) * 1e-4);
  EXPECT_GT(faults.count(), 100U);
  EXPECT_GT(samples, 5'000U);
  EXPECT_GT(frames, 500U);
  EXPECT_LT(wrong, link.corruptor().corrupted() / 10);
  // Each damaged byte costs one exchange at most.
  EXPECT_LE(counters.timeouts, link.corruptor().corrupted() + 20 * faults.count());
  EXPECT_LT(sample_gap, base::milliseconds(8'000));
  EXPECT_LT(longest_queue, 600U);
}

TEST(NxtHostile, FuzzedShortly) {
  std::mt19937 random(3);
  const std::vector<std::uint8_t> seed = {7, 0, 2, 0x88, 0, 0x7C, 1,    0x1D, 1, 7, 0,    2, 0x0D, 0, 0xC0, 0x27, 9, 0,
                                          5, 0, 2, 0x0B, 0, 0x78, 0x1E, 3,    0, 2, 0x05, 0, 20,   0, 2,    0x10, 0, 0,
                                          0, 0, 0, 0,    0, 0,    0,    0,    0, 0, 0,    0, 0,    0, 0,    0};
  for (int i = 0; i < 2'000; ++i) {
    std::vector<std::uint8_t> bytes;
    for (int k = 0; k < 8; ++k) bytes.insert(bytes.end(), seed.begin(), seed.end());
    for (int k = 0; k < 12; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

}  // namespace
}  // namespace fencepost::nxt
