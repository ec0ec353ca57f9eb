#include "drivers/nxtcam/serial_camera.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/bench/nxtcam_rig.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;
using Bench = test::Bench<test::NxtCamSerialRig>;
using Link = test::NxtCamSerialRig::Link;

static_assert(sensor::BlobCamera<SerialCamera<Link>>);

const sensor::Blob kRed{2, 60, 40, 81, 70, {705}, {550}, 0, {}};

TEST(SerialNxtCamera, StartsAndTracks) {
  Bench bench;
  bench.run(900, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  bench.run(1'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  EXPECT_EQ(bench.driver.version(), "AVRcam v1.4");
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_EQ(bench.frames.back().blobs[0], kRed);
  bench.run(100, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
}

TEST(SerialNxtCamera, AcknowledgingWithoutTrackingIsUnready) {
  Bench bench;
  bench.exposing = false;
  bench.run(3'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);
  EXPECT_TRUE(bench.frames.empty());
  bench.exposing = true;
  bench.run(200, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

// What a stalled line held back comes bunched together: only the first of it counts, in order of time.
TEST(SerialNxtCamera, FramesHeldUpInOneHeapAreDropped) {
  Bench bench;
  bench.run(3'000, {kRed});
  bench.link.set_bytes_per_ms(1'000);
  bench.link.stall();
  bench.run(500, {kRed});
  bench.link.resume();
  EXPECT_LE(bench.run(20, {kRed}).size(), 2U);
  EXPECT_GT(bench.driver.stale(), 5U);
  EXPECT_EQ(bench.disorder, 0U);
}

}  // namespace
}  // namespace fencepost::nxtcam
