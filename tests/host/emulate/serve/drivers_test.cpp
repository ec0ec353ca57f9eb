// Each emulated device with the project's own driver: every frame arrives and has the scene's boxes, as exactly as the
// sensor can tell them; the wheels bring the pose.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "drivers/can_wheels/layouts.hpp"
#include "drivers/can_wheels/wheels.hpp"
#include "drivers/cmucam/cmucam.hpp"
#include "drivers/create/create.hpp"
#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/xbc/xbc.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/host/emulate/serve/rig.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;
using Frames = std::vector<sensor::BlobFrame>;

constexpr int kFrames = 40;
constexpr base::Time kLongest{400'000};

template <class Poll>
Frames collect(Rig& rig, Poll poll) {
  Frames frames;
  while (!rig.stage.over(rig.clock.now()) && rig.clock.now() < kLongest) {
    rig.step();
    if (const auto frame = poll(rig.clock.now()); frame && rig.stage.begun()) frames.push_back(*frame);
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
  StageLink link = rig.add("pixy2");
  pixy2::Camera<StageLink> camera(link);
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
  StageLink link = rig.add(GetParam().name);
  cmucam::Config config;
  config.dialect = GetParam().dialect;
  ASSERT_TRUE(config.windows.push_back({1, 180, 240, 16, 60, 16, 60}));
  cmucam::CmuCam<StageLink> camera(link, config);
  expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }));
  EXPECT_GT(base::Duration(*rig.stage.begun() - base::Time{}).to_double(), 5) << "after the driver's settling";
}

INSTANTIATE_TEST_SUITE_P(All, EmulatedCmuCam,
                         testing::Values(CmuCam{"cmucam1", &cmucam::kCmuCam1}, CmuCam{"cmucam2", &cmucam::kCmuCam2},
                                         CmuCam{"cmucam3", &cmucam::kCmuCam3}, CmuCam{"cmucam4", &cmucam::kCmuCam4}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(EmulatedDevice, XbcShowsEveryFrame) {
  const Feed feed = moving_box(356, 291, kFrames);
  Rig rig(feed);
  StageLink link = rig.add("xbc");
  xbc::Xbc<StageLink> camera(link, xbc::Config{});
  expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }));
}

TEST(EmulatedDevice, NxtCamOnASerialLineShowsEveryFrame) {
  for (const char* name : {"nxtcam", "avrcam"}) {
    const Feed feed = moving_box(176, 144, kFrames);
    Rig rig(feed);
    StageLink link = rig.add(name);
    nxtcam::SerialCamera<StageLink> camera(link);
    expect_boxes(feed, collect(rig, [&](base::Time now) { return camera.poll(now); }), true);
  }
}

// Twenty transfers of a frame take longer than 0.1 s through a brick, so not each one is read; motors at the same time.
TEST(EmulatedDevice, NxtBringsWheelsAndACameraOnItsPort) {
  const Feed feed = moving_box(176, 144, 100);
  Rig rig(feed);
  StageLink link = rig.add("nxtcam:nxt,port=2");
  nxt::FramedLink<StageLink> framed(link);
  nxt::Brick<nxt::FramedLink<StageLink>> brick(framed);
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

/// A quarter of a circle of 1 m radius at 0.2 m/s, to the left.
Feed quarter_circle() {
  Feed feed;
  constexpr double kSpeed = 0.2;
  for (int i = 0; i * 0.02 * kSpeed <= std::numbers::pi / 2 + 1e-9; ++i) {
    const double angle = i * 0.02 * kSpeed;
    feed.poses.push_back({base::Time{200 * i}, base::Metres::nearest(std::sin(angle)),
                          base::Metres::nearest(1 - std::cos(angle)), base::Radians::nearest(angle)});
  }
  return feed;
}

template <class Driver>
sensor::OdometrySample end_of(Rig& rig, Driver& driver) {
  sensor::OdometrySample last;
  while (!rig.stage.over(rig.clock.now()) && rig.clock.now() < kLongest) {
    rig.step();
    if (const auto sample = driver.poll(rig.clock.now())) last = *sample;
  }
  return last;
}

TEST(EmulatedDevice, Create2BringsThePose) {
  const Feed feed = quarter_circle();
  Rig rig(feed);
  StageLink link = rig.add("create2");
  create::Create<StageLink> driver(link, create::Config{});
  const sensor::OdometrySample last = end_of(rig, driver);
  EXPECT_NEAR(last.x.to_double(), feed.poses.back().x.to_double(), 0.002);
  EXPECT_NEAR(last.y.to_double(), feed.poses.back().y.to_double(), 0.002);
  EXPECT_NEAR(last.heading.to_double(), feed.poses.back().heading.to_double(), 0.003);
}

// Each reading cuts off the fraction of a millimetre and of a degree, and both are small at 15 ms: the known loss of
// the real one. 3 mm and 0.17 degrees a reading: the heading is never told at all.
TEST(EmulatedDevice, Create1LosesFractionsAsARealOneDoes) {
  Rig rig(quarter_circle());
  StageLink link = rig.add("create1");
  create::Config config;
  config.model = create::Model::kCreate1;
  create::Create<StageLink> driver(link, config);
  const sensor::OdometrySample last = end_of(rig, driver);
  EXPECT_EQ(last.heading.raw, 0);
  EXPECT_GT(last.x.to_double(), 0.9);
  EXPECT_LT(last.x.to_double(), std::numbers::pi / 2);
}

TEST(EmulatedDevice, CanFramesBringThePose) {
  const Feed feed = quarter_circle();
  StageSettings settings;
  settings.delay = base::milliseconds(500);
  for (const bool talon : {false, true}) {
    Rig rig(feed, settings);
    rig.add(talon ? "can:vcan0,layout=talon" : "can:vcan0");
    can_wheels::Mapping mapping;
    mapping.left = talon ? can_wheels::talon_srx_position(3) : can_wheels::canopen_position(5);
    mapping.right = talon ? can_wheels::talon_srx_position(4) : can_wheels::canopen_position(6);
    mapping.wheels = {100'000'000, 100'000'000, 235'000'000'000, talon ? 24 : 32, 2'000};
    can_wheels::Wheels wheels(mapping);
    sensor::OdometrySample last;
    while (!rig.stage.over(rig.clock.now())) {
      rig.step();
      const Bytes bytes = rig.stage.station(0).to_host(rig.clock.now());
      for (std::size_t at = 0; at < bytes.size(); at += 16) {
        bus::CanFrame frame;
        std::uint32_t id = 0;
        std::memcpy(&id, &bytes[at], 4);
        frame.extended = (id >> 31U) != 0;
        frame.id = id & 0x1FFF'FFFFU;
        frame.length = bytes[at + 4];
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at) + 8, 8, frame.data.begin());
        if (const auto sample = wheels.take(frame, rig.clock.now())) last = *sample;
      }
    }
    EXPECT_NEAR(last.x.to_double(), feed.poses.back().x.to_double(), 0.002) << talon;
    EXPECT_NEAR(last.y.to_double(), feed.poses.back().y.to_double(), 0.002) << talon;
  }
}

struct PoseSink {
  std::vector<sensor::OdometrySample> poses;
  void accept(const sensor::OdometrySample& pose) { poses.push_back(pose); }
  template <class Record>
  void accept(const Record&) {}
};

TEST(EmulatedDevice, RecordsAreThePosesWithoutTime) {
  const Feed feed = quarter_circle();
  Rig rig(feed);
  rig.add("records");
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  PoseSink sink;
  std::string text;
  while (!rig.stage.over(rig.clock.now())) {
    rig.step();
    for (const std::uint8_t byte : rig.stage.station(0).to_host(rig.clock.now())) {
      text += static_cast<char>(byte);
      reader.push(static_cast<char>(byte), sink, {rig.clock.now()});
    }
  }
  EXPECT_EQ(reader.counts().rejected(), 0U);
  EXPECT_NE(text.find("$FPODO,,"), std::string::npos);
  // Every pose of the feed, in order; at its ends, where the robot stands, the same one again and again.
  std::size_t at = 0;
  for (const sensor::OdometrySample& pose : sink.poses) {
    const auto same = [&](const sensor::OdometrySample& shown) {
      return shown.x == pose.x && shown.y == pose.y && shown.heading == pose.heading;
    };
    if (at < feed.poses.size() && same(feed.poses[at])) ++at;
  }
  EXPECT_EQ(at, feed.poses.size());
}

// What no device knows is answered as the protocol says.
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
    StageLink link = rig.add(c.device);
    for (int i = 0; i < 3'500; ++i) rig.step();
    (void)rig.stage.station(0).to_host(rig.clock.now());
    ASSERT_TRUE(link.write(c.command));
    Bytes reply;
    for (int i = 0; i < 14; ++i) {
      rig.step();
      for (const std::uint8_t byte : rig.stage.station(0).to_host(rig.clock.now())) reply.push_back(byte);
    }
    EXPECT_EQ(reply, c.reply) << c.device;
  }
}

// A camera's own rate and its line's pace limit what it tells: 50 frames a second into one of 17 /s.
TEST(EmulatedDevice, SkipsFramesThatItIsTooSlowFor) {
  Feed feed = moving_box(80, 143, 100);
  for (std::size_t i = 0; i < feed.frames.size(); ++i) feed.frames[i].t = base::Time{200 * static_cast<int>(i)};
  StageSettings settings;
  settings.delay = base::Duration{};
  Rig rig(feed, settings);
  rig.add("cmucam1");
  while (!rig.stage.over(rig.clock.now())) rig.step();
  EXPECT_EQ(rig.stage.station(0).counts().frames, 34U) << "each third of 100";
  EXPECT_EQ(rig.stage.station(0).counts().skipped, 66U);
}

}  // namespace
}  // namespace fencepost::emulate
