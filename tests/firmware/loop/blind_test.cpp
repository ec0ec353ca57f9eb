// A robot that cannot know what is ahead says so in every mode, and says when it can again. The heartbeat goes on, and
// a replay of the log says the same.
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "firmware/loop/loop.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;
using sensor::LinkState;

template <class Item>
struct Sensor {
  std::deque<Item> items;
  base::Result<Item> poll(base::Time /*now*/) {
    if (items.empty()) return base::Error::kNotReady;
    const Item item = items.front();
    items.pop_front();
    return item;
  }
  [[nodiscard]] static LinkState link() { return LinkState::kOk; }
  [[nodiscard]] static std::uint32_t dropped() { return 0; }
  [[nodiscard]] bool stamped_here() const { return here; }
  bool here = true;
};

/// Takes all that is said.
struct Listener {
  std::string text;
  bool open = true;
  static base::Result<std::size_t> read(std::span<std::uint8_t> /*buffer*/) { return base::Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> bytes) {
    if (!open) return base::Error::kFull;
    text.append(bytes.begin(), bytes.end());
    return bytes.size();
  }
};

struct Records {
  std::vector<record::AlertReport> alerts;
  std::vector<record::Heartbeat> beats;
  void accept(const record::AlertReport& report) { alerts.push_back(report); }
  void accept(const record::Heartbeat& beat) { beats.push_back(beat); }
  template <class Record>
  void accept(const Record& /*not asked for*/) {}
};

/// A robot whose loop turns a hundred times a second, with 10 frames and 50 samples of odometry in each.
class BlindRobot {
 public:
  explicit BlindRobot(console::Mode mode) : loop(*memory, camera, odometry, link, mode) {
    loop.pipeline().start_run(header_);
    loop.pipeline().set_camera(level_pixy2());
  }

  void run(double seconds) {
    for (const double end = t + seconds - 1e-9; t < end;) {
      t += 0.01;
      x += 0.01 * speed;
      const int turn = static_cast<int>(std::lround(t * 100));
      const base::Time now = base::Time::nearest(t);
      if (odometry_on && turn % 2 == 0) odometry.items.push_back({now, base::Metres::nearest(x), {}, {}});
      if (camera_on && turn % 10 == 0) camera.items.push_back(flat_view({{3, -0.2, 0.2, 1}}, x, 0, t, number_++));
      loop.step(now);
    }
  }
  [[nodiscard]] Records records() const {
    Records records;
    std::array<char, record::StreamReader::kBuffer> buffer{};
    record::StreamReader reader(buffer);
    reader.push(link.text, records);
    return records;
  }

  using Profile = config::Small;
  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  Sensor<sensor::BlobFrame> camera;
  Sensor<sensor::OdometrySample> odometry;
  Listener link;
  loop::Loop<Profile, Sensor<sensor::BlobFrame>, Sensor<sensor::OdometrySample>, Listener> loop;
  bool camera_on = true;
  bool odometry_on = true;
  double speed = 0.2;
  double t = 0;
  double x = 0;

 private:
  record::Header header_{1, "fencepost", "0.0.0", "test", "small"};
  std::uint32_t number_ = 0;
};

struct Blind : testing::Test {
  BlindRobot robot{console::Mode::kLog};
};

TEST_F(Blind, NeverOfAHealthyRobotWhoseHeartBeatsTenTimesASecond) {
  robot.speed = 0.15;  // everything ahead stays beyond the distance of a notice
  robot.run(10);
  const Records records = robot.records();
  for (const record::AlertReport& alert : records.alerts) EXPECT_NE(alert.level, AlertLevel::kBlind);
  EXPECT_NEAR(static_cast<double>(records.beats.size()), 100, 2);
  ASSERT_GT(records.beats.size(), 10U);
  EXPECT_EQ(records.beats.front().level, AlertLevel::kBlind) << "nothing has been seen yet";
  EXPECT_EQ(records.beats.back().level, AlertLevel::kClear);
  EXPECT_EQ(records.beats.back().camera, LinkState::kOk);
  EXPECT_EQ(records.beats.back().odometry, LinkState::kOk);
}

TEST_F(Blind, IsSaidOfASilentCameraAndTakenBack) {
  robot.run(2);
  robot.camera_on = false;
  robot.run(1);
  const Records silent = robot.records();
  ASSERT_FALSE(silent.alerts.empty());
  EXPECT_EQ(silent.alerts.front().level, AlertLevel::kBlind);
  EXPECT_EQ(silent.alerts.front().id, record::kNoObject);
  EXPECT_LE(silent.alerts.front().t.to_double(), 2.3);
  EXPECT_EQ(silent.beats.back().level, AlertLevel::kBlind);
  EXPECT_EQ(silent.beats.back().camera, LinkState::kSilent);
  robot.camera_on = true;
  robot.run(0.2);
  const Records back = robot.records();
  EXPECT_EQ(back.alerts.back().level, AlertLevel::kClear);
  EXPECT_EQ(back.alerts.back().id, record::kNoObject);
}

TEST_F(Blind, IsSaidWhenBothAreSilentAndStreamTimeWouldStandStill) {
  robot.run(2);
  robot.camera_on = robot.odometry_on = false;
  robot.run(2);
  const Records records = robot.records();
  ASSERT_FALSE(records.alerts.empty());
  EXPECT_LE(records.alerts.front().t.to_double(), 2.3);
  EXPECT_GE(records.beats.back().t.to_double(), 3.8) << "the heart beats on";
  EXPECT_EQ(records.beats.back().odometry, LinkState::kSilent);
}

TEST_F(Blind, IsSaidOfARobotThatHasNeverSeenAnything) {
  BlindRobot fresh(console::Mode::kText);
  fresh.camera_on = fresh.odometry_on = false;
  fresh.run(2);
  EXPECT_NE(fresh.link.text.find("BLIND   the camera has sent no frame yet\r\n"), std::string::npos) << fresh.link.text;
}

// The loop was kept for two seconds, by a disk or a busy machine; the first thing that it finds came before that.
TEST_F(Blind, IsSaidAtOnceOfAnInputThatLayInABuffer) {
  robot.run(2);
  robot.camera.items.push_back(flat_view({{3, -0.2, 0.2, 1}}, robot.x, 0, robot.t + 0.01, 999));
  robot.t += 2;
  robot.loop.step(base::Time::nearest(robot.t));
  EXPECT_EQ(robot.loop.pipeline().in_force().level, AlertLevel::kBlind);
  EXPECT_GE(robot.loop.pipeline().stream_time()->to_double(), robot.t - 0.02);
}

// Inputs that are rejected do not keep stream time from passing.
TEST_F(Blind, IsSaidWhileAllThatComesIsRejected) {
  robot.run(2);
  robot.odometry_on = false;
  for (int i = 0; i < 50; ++i) {
    robot.odometry.items.push_back({base::Time::nearest(1), {}, {}, {}});  // long over
    robot.run(0.02);
  }
  const Records records = robot.records();
  ASSERT_FALSE(records.alerts.empty());
  EXPECT_EQ(records.alerts.front().level, AlertLevel::kBlind);
  EXPECT_LE(records.alerts.front().t.to_double(), 2.3);
  EXPECT_GE(records.beats.back().t.to_double(), 2.85);
}

// A replay knows nothing of refused inputs: no frame is given up because one came.
TEST_F(Blind, WhatIsRefusedHasNoEffects) {
  robot.run(2);
  robot.camera_on = robot.odometry_on = false;
  robot.run(0.1);
  robot.camera.items.push_back(flat_view({{3, -0.2, 0.2, 1}}, robot.x, 0, robot.t + 0.01, 999));
  robot.run(0.25);  // its pose is still to come, and heartbeats pass the time for which it may wait
  ASSERT_EQ(robot.memory->waiting.size(), 1U);
  robot.link.open = false;
  while (robot.memory->output.put(record::Signature{1, {}, "a long name to fill the queue"})) continue;
  const std::uint32_t before = robot.memory->counters.records_dropped;
  robot.odometry.items.push_back({base::Time::nearest(robot.t), base::Metres::nearest(robot.x), {}, {}});
  robot.run(0.02);
  ASSERT_GT(robot.memory->counters.records_dropped, before) << "it was refused";
  EXPECT_EQ(robot.memory->waiting.size(), 1U);
  robot.link.open = true;
  robot.run(0.02);
  const std::uint32_t frames = robot.memory->counters.frames;
  robot.odometry.items.push_back({base::Time::nearest(robot.t), base::Metres::nearest(robot.x), {}, {}});
  robot.run(0.02);
  EXPECT_EQ(robot.memory->counters.frames, frames + 1);
}

// A controller whose clock loses a tenth of a second each second: its time is followed.
TEST_F(Blind, IsNotSaidOfAStampThatFallsBehind) {
  robot.camera_on = robot.odometry_on = false;
  std::uint32_t number = 0;
  for (int i = 1; i <= 500; ++i) {
    const double stamp = 0.9 * 0.02 * i;
    robot.odometry.items.push_back({base::Time::nearest(stamp), base::Metres::nearest(robot.x), {}, {}});
    if (i % 5 == 0) robot.camera.items.push_back(flat_view({{3, -0.2, 0.2, 1}}, robot.x, 0, stamp, number++));
    robot.run(0.02);
  }
  for (const record::AlertReport& alert : robot.records().alerts)
    EXPECT_NE(alert.level, AlertLevel::kBlind) << alert.t.raw;
}

TEST_F(Blind, AStreamOfAnotherClockStandsStillWithItsSender) {
  robot.camera.here = robot.odometry.here = false;
  robot.run(2);
  robot.camera_on = robot.odometry_on = false;
  robot.run(2);
  EXPECT_LE(robot.records().beats.back().t.to_double(), 2.01);
}

TEST_F(Blind, IsSaidInEachMode) {
  for (const console::Mode mode : {console::Mode::kText, console::Mode::kPlot}) {
    BlindRobot fresh(mode);
    fresh.run(2);
    fresh.camera_on = false;
    fresh.run(0.5);
    const char* said =
        mode == console::Mode::kText ? "BLIND   no frame comes from the camera\r\n" : "level:4,camera:1,odometry:4\r\n";
    EXPECT_NE(fresh.link.text.find(said), std::string::npos) << fresh.link.text;
    fresh.camera_on = true;
    fresh.run(0.5);
    const char* after = mode == console::Mode::kText ? "CLEAR   it sees again\r\n" : "level:0,camera:4,odometry:4\r\n";
    EXPECT_NE(fresh.link.text.rfind(after), std::string::npos) << fresh.link.text;
  }
}

}  // namespace
}  // namespace fencepost::test
