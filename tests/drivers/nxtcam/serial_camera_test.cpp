#include "drivers/nxtcam/serial_camera.hpp"

#include <gtest/gtest.h>

#include "host/emulate/nxtcam.hpp"
#include "tests/drivers/emulated_link.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;
using Link = test::EmulatedLink<emulate::NxtCam>;

static_assert(sensor::BlobCamera<SerialCamera<Link>>);

const sensor::Blob kRed{2, 60, 40, 81, 70, {705}, {550}, 0, {}};

struct Bench {
  fake::SteppedClock clock;
  emulate::NxtCam device{base::Time{}};
  Link link{device, clock};
  SerialCamera<Link> camera{link};
  std::vector<sensor::BlobFrame> frames;

  void run(std::int64_t ms, const std::vector<sensor::Blob>& blobs) {
    for (std::int64_t i = 0; i < ms; ++i) {
      clock.advance(base::milliseconds(1));
      if (i % 33 == 0) device.show(blobs), link.inject(device.packet());
      if (const auto frame = camera.poll(clock.now())) frames.push_back(*frame);
    }
  }
};

TEST(SerialNxtCamera, StartsAndTracks) {
  Bench bench;
  bench.run(900, {kRed});
  EXPECT_EQ(bench.camera.link(), LinkState::kSilent);
  bench.run(1'000, {kRed});
  EXPECT_EQ(bench.camera.link(), LinkState::kOk);
  EXPECT_EQ(bench.camera.version(), "AVRcam v1.4");
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_EQ(bench.frames.back().blobs[0], kRed);
  bench.run(100, {});
  EXPECT_EQ(bench.camera.link(), LinkState::kEmpty);
}

TEST(SerialNxtCamera, ComesBackAfterAPowerCycleAndAnUnplug) {
  Bench bench;
  bench.run(2'000, {kRed});
  bench.device.restart(bench.clock.now());
  bench.run(1'010, {kRed});
  EXPECT_EQ(bench.camera.link(), LinkState::kSilent);
  bench.run(1'500, {kRed});
  EXPECT_EQ(bench.camera.link(), LinkState::kOk);
  bench.link.unplug();
  bench.run(10, {kRed});
  EXPECT_EQ(bench.camera.link(), LinkState::kAbsent);
  bench.link.replug();
  bench.run(2'000, {kRed});
  EXPECT_EQ(bench.camera.link(), LinkState::kOk);
}

// A line that dies and a port that comes back without a camera.
TEST(SerialNxtCamera, APortWithoutACameraIsSilent) {
  Bench bench;
  bench.device.restart(base::Time{1'000'000'000});
  bench.link.unplug();
  bench.run(500, {});
  EXPECT_EQ(bench.camera.link(), LinkState::kAbsent);
  bench.link.replug();
  bench.run(600, {});
  EXPECT_EQ(bench.camera.link(), LinkState::kSilent);
}

}  // namespace
}  // namespace fencepost::nxtcam
