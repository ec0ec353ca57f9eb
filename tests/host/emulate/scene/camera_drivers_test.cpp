// Each emulated device with the project's own driver: every frame arrives and has the scene's boxes, as exactly as the
// sensor can tell them.
#include <gtest/gtest.h>

#include "drivers/cmucam/cmucam.hpp"
#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/xbc/xbc.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/host/emulate/scene/rig.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;
using Frames = std::vector<sensor::BlobFrame>;

constexpr int kFrames = 40;
constexpr base::Time kLongest{400'000};

template <class Poll>
Frames collect(Rig& rig, Poll poll) {
  Frames frames;
  while (!rig.playback.over(rig.clock.now()) && rig.clock.now() < kLongest) {
    rig.step();
    if (const auto frame = poll(rig.clock.now()); frame && rig.playback.begun()) frames.push_back(*frame);
  }
  return frames;
}

/// Frames without a blob are dropped: before time begins a camera that streams sees nothing.
void expect_boxes(const Feed& feed, const Frames& frames, bool doubled_columns = false) {
  std::size_t at = 0;
  int last_x1 = -1;
  for (const sensor::BlobFrame& frame : frames) {
    if (frame.blobs.empty()) continue;
    // At the end a camera that never rests sees the last one again.
    if (at == feed.frames.size() && frame.blobs[0].x1 == last_x1) continue;
    last_x1 = frame.blobs[0].x1;
    ASSERT_LT(at, feed.frames.size());
    const sensor::Blob& shown = feed.frames[at].blobs[0];
    ASSERT_EQ(frame.blobs.size(), 1U);
    const sensor::Blob& seen = frame.blobs[0];
    EXPECT_EQ(seen.signature, 1);
    EXPECT_EQ(seen.x1, doubled_columns ? shown.x1 - shown.x1 % 2 : shown.x1) << at;
    EXPECT_EQ(seen.x2, doubled_columns ? shown.x2 - shown.x2 % 2 + 1 : shown.x2) << at;
    EXPECT_EQ(seen.y1, shown.y1) << at;
    EXPECT_EQ(seen.y2, shown.y2) << at;
    ++at;
  }
  EXPECT_EQ(at, feed.frames.size()) << "every frame, from the first one on";
}

TEST(EmulatedDevice, Pixy2ShowsEveryFrame) {
  const Feed feed = moving_box(316, 208, kFrames);
  Rig rig(feed);
  EndpointLink link = rig.add("pixy2");
  pixy2::Camera<EndpointLink> camera(link);
  expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }));
}

struct CmuCam {
  const char* name;
  const cmucam::Dialect* dialect;
};

class EmulatedCmuCam : public testing::TestWithParam<CmuCam> {};

TEST_P(EmulatedCmuCam, ShowsEveryFrame) {
  const Feed feed = moving_box(GetParam().dialect->width, GetParam().dialect->height, kFrames);
  Rig rig(feed);
  EndpointLink link = rig.add(GetParam().name);
  cmucam::Config config;
  config.dialect = GetParam().dialect;
  ASSERT_TRUE(config.windows.push_back({1, 180, 240, 16, 60, 16, 60}));
  cmucam::CmuCam<EndpointLink> camera(link, config);
  expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }));
  EXPECT_GT(base::Duration(*rig.playback.begun() - base::Time{}).to_double(), 5) << "after the driver's settling";
}

INSTANTIATE_TEST_SUITE_P(All, EmulatedCmuCam,
                         testing::Values(CmuCam{"cmucam1", &cmucam::kCmuCam1}, CmuCam{"cmucam2", &cmucam::kCmuCam2},
                                         CmuCam{"cmucam3", &cmucam::kCmuCam3}, CmuCam{"cmucam4", &cmucam::kCmuCam4}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(EmulatedDevice, XbcShowsEveryFrame) {
  const Feed feed = moving_box(356, 291, kFrames);
  Rig rig(feed);
  EndpointLink link = rig.add("xbc");
  xbc::Xbc<EndpointLink> camera(link, xbc::Config{});
  expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }));
}

TEST(EmulatedDevice, NxtCamOnASerialLineShowsEveryFrame) {
  for (const char* name : {"nxtcam", "avrcam"}) {
    const Feed feed = moving_box(176, 144, kFrames);
    Rig rig(feed);
    EndpointLink link = rig.add(name);
    nxtcam::SerialCamera<EndpointLink> camera(link);
    expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }), true);
  }
}

// Twenty transfers of a frame take longer than 0.1 s through a brick, so not each one is read; motors at the same time.
TEST(EmulatedDevice, NxtBringsWheelsAndACameraOnItsPort) {
  const Feed feed = moving_box(176, 144, 100);
  Rig rig(feed);
  EndpointLink link = rig.add("nxtcam:nxt,port=2");
  nxt::FramedLink<EndpointLink> framed(link);
  nxt::Brick<nxt::FramedLink<EndpointLink>> brick(framed);
  nxt::SensorPort port(brick.conversation(), 1);
  nxtcam::Camera<nxt::SensorPort> camera(port);
  nxt::TachoOdometry odometry(brick.conversation(), {});
  sensor::OdometrySample last;
  const Frames frames = collect(rig, [&](base::Time now) {
    brick.poll(now);
    if (const auto sample = odometry.poll(now)) last = *sample;
    return camera.poll(now);
  });
  std::size_t seen = 0;
  std::size_t at = 0;
  for (const sensor::BlobFrame& frame : frames) {
    if (frame.blobs.empty()) continue;
    // In the feed's order, gaps allowed.
    const auto same = [&](const sensor::BlobFrame& shown) {
      const sensor::Blob& blob = shown.blobs[0];
      return frame.blobs[0].x1 == blob.x1 - blob.x1 % 2 && frame.blobs[0].y2 == blob.y2;
    };
    while (at < feed.frames.size() && !same(feed.frames[at])) ++at;
    ASSERT_LT(at, feed.frames.size()) << "a box that was never shown, or came back";
    ++seen;
  }
  EXPECT_GT(seen, 30U);
  EXPECT_NEAR(last.x.to_double(), 2, 0.002) << "100 frames at 10 /s and 0.2 m/s";
  EXPECT_NEAR(last.y.to_double(), 0, 0.002);
}

// A command that no device knows is answered as the protocol says.
TEST(EmulatedDevice, AnswersTheUnknownWithItsOwnError) {
  struct Case {
    const char* device;
    Bytes command;
    Bytes reply;
  };
  const std::vector<Case> cases = {
      {"pixy2", hex("AE C1 55 00"), hex("AF C1 03 01 FC 00 FC")},
      {"cmucam1", hex("58 58 0D"), hex("4E 43 4B 0D 3A")},
      {"cmucam3", hex("54 43 20 31 0D"), hex("4E 43 4B 0D 3A")},
      {"cmucam4", hex("52 4D 20 31 0D"), hex("4E 43 4B 0D 3A")},
      {"avrcam", hex("58 58 0D"), hex("4E 43 4B 0D")},
      {"nxt", hex("02 00 00 77"), hex("03 00 02 77 BE")},
      {"nxt", hex("05 00 00 05 09 0B 00"), hex("03 00 02 05 C0")},
      {"create2", hex("FE"), {}},
      {"xbc", hex("21"), {}},
  };
  for (const Case& c : cases) {
    Rig rig(moving_box(10, 10, 1));
    EndpointLink link = rig.add(c.device);
    for (int i = 0; i < 3'500; ++i) rig.step();
    (void)rig.playback.endpoint(0).to_host(rig.clock.now());
    ASSERT_TRUE(link.write(c.command));
    Bytes reply;
    for (int i = 0; i < 14; ++i) {
      rig.step();
      for (const std::uint8_t byte : rig.playback.endpoint(0).to_host(rig.clock.now())) reply.push_back(byte);
    }
    EXPECT_EQ(reply, c.reply) << c.device;
  }
}

// A camera's own rate and its line's pace limit what it tells: 50 frames a second into one of 17 /s.
TEST(EmulatedDevice, SkipsFramesThatItIsTooSlowFor) {
  Feed feed = moving_box(80, 143, 100);
  for (std::size_t i = 0; i < feed.frames.size(); ++i) feed.frames[i].t = base::Time{200 * static_cast<int>(i)};
  PlaybackSettings settings;
  settings.delay = base::Duration{};
  Rig rig(feed, settings);
  rig.add("cmucam1");
  while (!rig.playback.over(rig.clock.now())) rig.step();
  EXPECT_EQ(rig.playback.endpoint(0).counts().frames, 34U) << "each third of 100";
  EXPECT_EQ(rig.playback.endpoint(0).counts().skipped, 66U);
}

}  // namespace
}  // namespace fencepost::emulate
