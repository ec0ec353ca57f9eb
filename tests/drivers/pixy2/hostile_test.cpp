// One hour on a bad cable: 1 % of the bytes damaged, both ways, and every 20 s a stall, a reboot or an unplug.
#include <gtest/gtest.h>

#include "drivers/pixy2/camera.hpp"
#include "host/emulate/pixy2.hpp"
#include "tests/drivers/emulated_link.hpp"
#include "tests/drivers/faults.hpp"

namespace fencepost::pixy2 {
namespace {

using test::Faults;
using Link = test::EmulatedLink<emulate::Pixy2>;

// Frames differ, so that a damaged one is not mistaken for another.
sensor::Blob blob_of(std::int64_t frame) {
  const auto x = static_cast<std::int16_t>(frame % 200);
  const auto y = static_cast<std::int16_t>(frame / 200 % 150);
  return {3, x, y, static_cast<std::int16_t>(x + 40), static_cast<std::int16_t>(y + 30), {10 * x + 200}, {10 * y + 150},
          0, {}};
}

TEST(Pixy2Hostile, LosesOneFrameACorruptionAtMost) {
  constexpr std::int64_t kStep = 2;
  fake::SteppedClock clock;
  emulate::Pixy2 device{base::Time{}};
  Link link{device, clock, 0.01, 7};
  Camera<Link> camera(link);
  Faults faults(3);
  std::uint32_t received = 0;
  std::uint32_t undetected = 0;
  base::Time last{};
  base::Duration longest_gap{};
  std::size_t longest_queue = 0;
  std::int64_t shown = 0;
  for (std::int64_t ms = 0; ms < 3'600'000; ms += kStep) {
    clock.advance(base::milliseconds(kStep));
    const base::Time now = clock.now();
    switch (faults.begin(now)) {
      case Faults::Kind::kNone: break;
      case Faults::Kind::kStall: link.stall(); break;
      case Faults::Kind::kReboot:
        device.restart(now);
        link.forget();
        break;
      case Faults::Kind::kUnplug: link.unplug(); break;
    }
    if (faults.over(now)) link.resume(), link.replug();
    if (ms % 16 == 0) device.show({blob_of(++shown)});
    longest_queue = std::max(longest_queue, link.waiting());
    if (faults.quiet(now) > base::milliseconds(4'000)) longest_gap = std::max(longest_gap, now - last);
    const auto frame = camera.poll(now);
    if (!frame) continue;
    ++received;
    last = now;
    const bool good =
        frame->blobs.size() == 1 && (frame->blobs[0] == blob_of(shown) || frame->blobs[0] == blob_of(shown - 1) ||
                                     frame->blobs[0] == blob_of(shown - 2));
    undetected += good ? 0 : 1;
  }
  RecordProperty("received", static_cast<int>(received));
  std::printf("frames %u of %u sent, %u bytes damaged, %u undetected, %u faults, longest gap %.3f s\n", received,
              device.frames_sent(), link.corruptor().corrupted(), undetected, faults.count(),
              static_cast<double>(longest_gap.raw) * 1e-4);
  EXPECT_GT(faults.count(), 100U);
  EXPECT_GT(received, 100'000U);
  EXPECT_LE(device.frames_sent() - received, link.corruptor().corrupted() + 2 * faults.count());
  EXPECT_LE(undetected, received / 10'000);
  EXPECT_LT(longest_gap, base::milliseconds(3'000));  // a new start is damaged as often
  EXPECT_LT(longest_queue, 600U);
}

}  // namespace
}  // namespace fencepost::pixy2
