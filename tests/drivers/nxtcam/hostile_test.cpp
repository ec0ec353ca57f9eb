// One hour on a bad bus: 1 % of the bytes damaged, both ways, and every 20 s a stall, a reboot or an unplug. Registers
// have no checksum: what is damaged within the possible goes through, and is counted here.
#include <gtest/gtest.h>

#include "drivers/nxtcam/camera.hpp"
#include "host/emulate/nxtcam.hpp"
#include "tests/drivers/emulated_i2c.hpp"
#include "tests/drivers/faults.hpp"

namespace fencepost::nxtcam {
namespace {

using test::Faults;

sensor::Blob blob_of(std::int64_t frame) {
  const auto x = static_cast<std::int16_t>(2 * (frame % 60));
  const auto y = static_cast<std::int16_t>(frame / 60 % 100);
  return {3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
          0, {}};
}

TEST(NxtCamHostile, LosesOneFrameACorruptionAtMost) {
  constexpr std::int64_t kStep = 3;
  fake::SteppedClock clock;
  emulate::NxtCam device{base::Time{}};
  test::EmulatedI2c bus{device, clock, 0.01, 5};
  Camera<test::EmulatedI2c> camera(bus);
  Faults faults(4);
  std::uint32_t received = 0;
  std::uint32_t wrong = 0;
  base::Time last{};
  base::Duration longest_gap{};
  std::int64_t shown = 0;
  for (std::int64_t ms = 0; ms < 3'600'000; ms += kStep) {
    clock.advance(base::milliseconds(kStep));
    const base::Time now = clock.now();
    switch (faults.begin(now)) {
      case Faults::Kind::kNone: break;
      case Faults::Kind::kStall: bus.stall(); break;
      case Faults::Kind::kReboot: device.restart(now); break;
      case Faults::Kind::kUnplug: bus.unplug(); break;
    }
    if (faults.over(now)) bus.resume(), bus.replug();
    if (ms % 33 == 0) device.show({blob_of(++shown)});
    if (faults.quiet(now) > base::milliseconds(8'000)) longest_gap = std::max(longest_gap, now - last);
    const auto frame = camera.poll(now);
    if (!frame) continue;
    ++received;
    last = now;
    const bool good =
        frame->blobs.size() == 1 && (frame->blobs[0] == blob_of(shown) || frame->blobs[0] == blob_of(shown - 1));
    wrong += good ? 0 : 1;
  }
  const std::uint32_t corrupted = bus.corruptor().corrupted();
  std::printf("frames %u, %u of them wrong, %u rejected, %u bytes damaged, %u faults, longest gap %.3f s\n", received,
              wrong, camera.session().counters().rejected, corrupted, faults.count(),
              static_cast<double>(longest_gap.raw) * 1e-4);
  EXPECT_GT(faults.count(), 100U);
  EXPECT_GT(received, 60'000U);
  // Each damaged byte harms one frame at most, and most lie behind the count, where they harm none.
  EXPECT_LT(wrong + camera.session().counters().rejected, corrupted);
  EXPECT_GT(camera.session().counters().rejected, 100U);
  EXPECT_LT(longest_gap, base::milliseconds(8'000));
}

}  // namespace
}  // namespace fencepost::nxtcam
