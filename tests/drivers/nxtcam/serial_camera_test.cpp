#include "drivers/nxtcam/serial_camera.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/bench/nxtcam_rig.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;
using SerialBench = test::Bench<test::NxtCamSerialRig>;
using Link = test::NxtCamSerialRig::Link;

static_assert(sensor::BlobCamera<SerialCamera<Link>>);

const sensor::Blob kSerialRed{2, 60, 40, 81, 70, {705}, {550}, 0, {}};

TEST(SerialNxtCamera, StartsAndTracks) {
  SerialBench bench;
  bench.run(900, {kSerialRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  bench.run(1'000, {kSerialRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  EXPECT_EQ(bench.driver.version(), "AVRcam v1.4");
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_EQ(bench.frames.back().blobs[0], kSerialRed);
  bench.run(100, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
}

// Frames held back by a stalled line come bunched together: only the first of them counts, in order of time.
TEST(SerialNxtCamera, FramesHeldUpInOneHeapAreDropped) {
  SerialBench bench;
  bench.run(3'000, {kSerialRed});
  bench.link.set_bytes_per_ms(1'000);
  bench.link.stall();
  bench.run(500, {kSerialRed});
  bench.link.resume();
  EXPECT_LE(bench.run(20, {kSerialRed}).size(), 2U);
  EXPECT_GT(bench.driver.stale(), 5U);
  EXPECT_EQ(bench.disorder, 0U);
}

}  // namespace
}  // namespace fencepost::nxtcam
