// Each emulated wheel base with the project's own driver brings the scene's pose.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "drivers/can_wheels/layouts.hpp"
#include "drivers/can_wheels/wheels.hpp"
#include "drivers/create/create.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/host/emulate/scene/rig.hpp"

namespace fencepost::emulate {
namespace {

constexpr base::Time kLongest{400'000};

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
  while (!rig.playback.over(rig.clock.now()) && rig.clock.now() < kLongest) {
    rig.step();
    if (const auto sample = driver.poll(rig.clock.now())) last = *sample;
  }
  return last;
}

TEST(EmulatedWheels, Create2BringsThePose) {
  const Feed feed = quarter_circle();
  Rig rig(feed);
  EndpointLink link = rig.add("create2");
  create::Create<EndpointLink> driver(link, create::Config{});
  const sensor::OdometrySample last = end_of(rig, driver);
  EXPECT_NEAR(last.x.to_double(), feed.poses.back().x.to_double(), 0.002);
  EXPECT_NEAR(last.y.to_double(), feed.poses.back().y.to_double(), 0.002);
  EXPECT_NEAR(last.heading.to_double(), feed.poses.back().heading.to_double(), 0.003);
}

// A frame's reading would be 3 mm and 0.17 degrees, cut off to 3 and 0: the turn would never be reported. The requested
// speeds are whole mm/s.
TEST(EmulatedWheels, Create1BringsThePose) {
  const Feed feed = quarter_circle();
  Rig rig(feed);
  EndpointLink link = rig.add("create1");
  create::Config config;
  config.model = create::Model::kCreate1;
  config.wheels = odometry::kCreate1Wheels;
  create::Create<EndpointLink> driver(link, config);
  const sensor::OdometrySample last = end_of(rig, driver);
  EXPECT_NEAR(last.x.to_double(), feed.poses.back().x.to_double(), 0.01);
  EXPECT_NEAR(last.y.to_double(), feed.poses.back().y.to_double(), 0.01);
  EXPECT_NEAR(last.heading.to_double(), feed.poses.back().heading.to_double(), 0.01);
}

TEST(EmulatedWheels, CanFramesBringThePose) {
  const Feed feed = quarter_circle();
  PlaybackSettings settings;
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
    while (!rig.playback.over(rig.clock.now())) {
      rig.step();
      const Bytes bytes = rig.playback.endpoint(0).to_host(rig.clock.now());
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

TEST(EmulatedWheels, RecordsAreThePosesWithoutTime) {
  const Feed feed = quarter_circle();
  Rig rig(feed);
  rig.add("records");
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  PoseSink sink;
  std::string text;
  while (!rig.playback.over(rig.clock.now())) {
    rig.step();
    for (const std::uint8_t byte : rig.playback.endpoint(0).to_host(rig.clock.now())) {
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

}  // namespace
}  // namespace fencepost::emulate
