// `fencepost run` with wheels on the kernel's own SocketCAN, played by canplayer and by `fencepost emulate`.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "hal/linux/can.hpp"
#include "host/emulate/models/can_wheels.hpp"
#include "host/emulate/models/wheel_adapters.hpp"
#include "host/emulate/scene/feed.hpp"
#include "host/emulate/scene/travel.hpp"
#include "host/scene/load.hpp"
#include "tests/guest/live_run.hpp"

namespace fencepost::guest {
namespace {

constexpr double kWay = 0.5;       // of the scene
constexpr double kCount = 0.0001;  // metres, as `emulate` has it
constexpr double kTrack = 0.235;
// A drive of five seconds past a post.
constexpr const char* kScene = R"({"format": 1, "seed": 1,
  "camera": {"model": "pixy2", "width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 103.5, "k1": 0,
             "mount": {"x": 0, "y": 0, "z": 0.12, "yaw": 0, "pitch": 0}, "latency": 0.05, "rate": 10, "max_blobs": 16},
  "robot": {"width": 0.2},
  "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}],
  "objects": [{"name": "post", "signature": 1, "height": 0.2, "footprint": {"circle": [1.3, 0.2, 0.05]}}],
  "path": {"type": "waypoints", "points": [[0, 0], [0.5, 0]], "speed": 0.1, "turn_rate": 0.8}})";
// The robot's configuration, by the scene's figures.
constexpr const char* kRobot = R"({
  "camera": {"mount": {"z": 0.12}, "latency": 0.05},
  "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}],
  "wheels": {"metres_per_tick": 0.0001, "track": 0.235},
  "can": {"left": {"id": "0x185", "byte": 2}, "right": {"id": "0x186", "byte": 2}}})";

/// On a starved processor up to 2 mm of the way were seen to be missing.
constexpr double kLost = 0.1;

bool shell(const std::string& line) { return std::system(line.c_str()) == 0; }

/// A line as candump -l writes it.
std::string candump_line(base::Time t, const bus::CanFrame& frame) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "(%.6f) vcan0 %03X#", 1'700'000'000 + t.to_double(), frame.id);
  std::string line = text.data();
  for (std::size_t i = 0; i < frame.length; ++i) {
    std::snprintf(text.data(), text.size(), "%02X", static_cast<unsigned>(frame.data[i]));
    line += text.data();
  }
  return line + "\n";
}

/// The wheels' frames from one time of the scene to another.
std::string candump_of(const host::Scene& scene, base::Time from, base::Time to) {
  const emulate::Feed feed = emulate::feed_from_scene(scene);
  const emulate::TravelLog travel(feed.poses);
  emulate::CanWheels wheels(emulate::CanWheels::Kind::kCanopen, from - emulate::CanWheels::kBoot);
  std::string text;
  for (base::Time t = wheels.next(); t < to; t = wheels.next()) {
    const emulate::Travel now = travel.at(t);
    const auto counts = [](double way) { return static_cast<std::int32_t>(emulate::counts_of(way, kCount)); };
    wheels.turn(counts(now.left(kTrack)), counts(now.right(kTrack)), 0, 0);
    for (const bus::CanFrame& frame : wheels.frames(t)) text += candump_line(t, frame);
  }
  return text;
}

/// The robot at one interface, the wheels at another, or the same.
class CanRun : public LiveRun {
 protected:
  CanRun(std::string ours, std::string theirs) : ours_(std::move(ours)), theirs_(std::move(theirs)) {}
  void SetUp() override {
    write("robot.json", kRobot);
    host::testing::spill(far.path() / "scene.json", kScene);
  }

  void emulate(std::vector<std::string> devices, const std::vector<std::string>& options = {}) {
    std::vector<std::string> words = {"emulate"};
    words.insert(words.end(), devices.begin(), devices.end());
    words.insert(words.end(), {"scene.json", "--loop"});  // however slow the processor is, there are pictures
    emulator.emplace(far, words);
    ASSERT_TRUE(emulator->says("pixy2 on cam")) << emulator->err();
    start("pixy2:" + (far.path() / "cam").string(), "can:" + ours_, options);
    ASSERT_TRUE(emulator->says("time begins")) << emulator->err() << run->err();
  }
  void play(const std::string& candump) {
    write("wheels.candump", candump);
    EXPECT_TRUE(shell("canplayer -I " + (folder.path() / "wheels.candump").string() + " > /dev/null"));
  }
  void down_and_up() {
    ASSERT_TRUE(shell("ip link set " + ours_ + " down"));
    EXPECT_TRUE(run->says(kGone)) << run->err();
    // The program looks for it several times and reports it once: wait until the camera has shown seven pictures.
    EXPECT_TRUE(logs("$FPFRM,", count(log(), "$FPFRM,") + 7)) << run->err();
    ASSERT_TRUE(shell("ip link set " + ours_ + " up"));
  }
  void expect_emulated_wheels();
  void expect_alerts_on_the_bus();

  const std::string ours_;
  const std::string theirs_;
  const std::string kGone = "odometry can at " + ours_ + " is absent";
  host::testing::Folder far;
  std::optional<Process> emulator;
};

class RunOnCan : public CanRun {
 protected:
  RunOnCan() : CanRun("vcan0", "vcan0") {}
  void SetUp() override {
    ASSERT_TRUE(shell("ip link add vcan0 type vcan && ip link set vcan0 up"));
    CanRun::SetUp();
  }
  void TearDown() override { shell("ip link delete vcan0"); }
};

/// Two controllers of a real make, on one bus.
class RunOnKvaser : public CanRun {
 protected:
  RunOnKvaser() : CanRun("can0", "can1") {}
  void SetUp() override {
    if (!shell("ip link show can1 > /dev/null 2>&1")) GTEST_SKIP() << "needs toolchain/guest/run --kvaser";
    for (const std::string& name : {ours_, theirs_}) {
      ASSERT_TRUE(shell("ip link set " + name + " type can bitrate 500000 && ip link set " + name + " up"));
    }
    CanRun::SetUp();
  }
  void TearDown() override { shell("ip link set can0 down; ip link set can1 down"); }
};

TEST_F(RunOnCan, FollowsWhatCanplayerPlaysAndSurvivesTheInterfaceGoingDown) {
  const auto scene = host::parse_scene(kScene, "scene");
  ASSERT_TRUE(scene.ok());
  const base::Time arrived{base::Time::nearest(5.5)};
  emulate({"pixy2:cam"});
  // At first, or some of the way is gone before the first pair.
  const base::Duration standing = base::milliseconds(200);
  play(candump_of(*scene, base::Time{} - standing, arrived));
  EXPECT_TRUE(arrives_at(kWay, kLost)) << x() << run->err();
  down_and_up();
  const std::string before = log();
  EXPECT_GE(count(before, "$FPFRM,"), 20U);
  ASSERT_TRUE(host::testing::eventually([this] { return said("odometry can at vcan0 works") >= 1; }));
  play(candump_of(*scene, arrived, arrived + base::milliseconds(1'000)));
  EXPECT_TRUE(logs("$FPODO,", count(before, "$FPODO,") + 40)) << run->err();  // 50 pairs of frames
  EXPECT_TRUE(arrives_at(kWay, kLost)) << x();
  expect_replays();
  EXPECT_EQ(said(kGone), 1U) << run->err();
}

void CanRun::expect_emulated_wheels() {
  emulate({"can:" + theirs_, "pixy2:cam"});
  expect_flow("at first");
  down_and_up();
  expect_flow("after the interface went down and up");
  expect_replays();
  EXPECT_EQ(said(kGone), 1U) << run->err();
  emulator->signal(SIGINT);
  emulator->wait();
}

TEST_F(RunOnCan, FollowsEmulatedWheelsThroughTheInterfaceGoingDown) { expect_emulated_wheels(); }
TEST_F(RunOnKvaser, FollowsEmulatedWheelsThroughTheInterfaceGoingDown) { expect_emulated_wheels(); }

/// Another node on the bus, which hears the alert.
class Listener {
 public:
  Listener(const std::string& interface, std::uint32_t id)
      : can_(linux::Can::open({interface, {{id, 0x1FFF'FFFF, false}}}, linux::MonotonicClock())) {
    EXPECT_TRUE(can_.ok());
  }
  std::vector<bus::CanFrame> heard() {
    while (true) {
      const base::Result<bus::CanFrame> frame = can_->receive();
      if (!frame) return all_;
      all_.push_back(*frame);
    }
  }

 private:
  linux::Opened<linux::Can> can_;
  std::vector<bus::CanFrame> all_;
};

bool may_move(const bus::CanFrame& frame) { return (frame.data[0] & 8U) != 0; }
unsigned level(const bus::CanFrame& frame) { return frame.data[0] & 7U; }

void CanRun::expect_alerts_on_the_bus() {
  Listener listener(theirs_, 0x123);
  emulate({"can:" + theirs_, "pixy2:cam"}, {"--alert-can", ours_ + ":123"});
  expect_flow("at first");
  EXPECT_TRUE(host::testing::eventually([&] {
    const auto frames = listener.heard();
    return frames.size() > 20 && may_move(frames.back());
  })) << run->err();
  run->signal(SIGINT);
  EXPECT_EQ(run->wait(), 130) << run->err();
  const std::vector<bus::CanFrame> frames = listener.heard();
  ASSERT_GT(frames.size(), 20U);
  EXPECT_EQ(level(frames.front()), 4U) << "blind, until the first picture";
  EXPECT_FALSE(may_move(frames.front()));
  EXPECT_EQ(level(frames.back()), 4U) << "and at the end";
  EXPECT_FALSE(may_move(frames.back()));
  base::Duration longest;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].data[7], static_cast<std::uint8_t>(frames[i - 1].data[7] + 1)) << "counted";
    longest = std::max(longest, *frames[i].received - *frames[i - 1].received);
  }
  RecordProperty("longest_ms", static_cast<int>(1000 * longest.to_double()));
  std::printf("longest pause between two frames: %.0f ms\n", 1000 * longest.to_double());
  // On a processor that emulates another one; the desk's test of the same code holds it to 100 ms.
  EXPECT_LE(longest, base::milliseconds(500));
}

TEST_F(RunOnCan, TellsTheAlertOnTheSameBus) { expect_alerts_on_the_bus(); }
TEST_F(RunOnKvaser, TellsTheAlertToTheOtherController) { expect_alerts_on_the_bus(); }

}  // namespace
}  // namespace fencepost::guest
