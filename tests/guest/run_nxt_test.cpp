// `fencepost run` on an NXT brick with motors and an NXTCam: only the wire of USB is made of software.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <thread>

#include "drivers/nxtcam/camera.hpp"
#include "host/emulate/models/nxt.hpp"
#include "host/emulate/models/nxtcam.hpp"
#include "tests/guest/approach.hpp"
#include "tests/guest/live_run.hpp"
#include "tests/guest/nxt_model.hpp"

namespace fencepost::guest {
namespace {

constexpr base::Duration kLongAgo = base::milliseconds(10'000);
const std::string kNoWheels = "odometry nxt on USB is absent";
const std::string kNoCamera = "camera nxtcam behind the NXT brick is absent";
constexpr double kMetresPerDegree = std::numbers::pi * 0.056 / 360;

class NxtRobot {
 public:
  NxtRobot() : usb_(model()) {
    camera_.teach(0xFF);
    brick_.attach(0, &camera_);
    usb_.plug();
    world_ = std::thread([this] { turn(); });
  }
  ~NxtRobot() {
    ended_ = true;
    world_.join();
  }
  NxtRobot(const NxtRobot&) = delete;
  NxtRobot& operator=(const NxtRobot&) = delete;

  UsbipDevice& usb() { return usb_; }
  void drive() { world_of_posts_.drive(); }
  std::atomic<bool> silent = false;
  std::atomic<bool> split = false;  ///< each reply comes as two transfers
  std::atomic<int> splits = 0;      ///< replies that came so
  std::atomic<int> turns = 0;       ///< of the world, 30 ms each

 private:
  UsbModel model() {
    UsbModel model = nxt_model();
    model.on_bulk = [this](const Bytes& telegram) { answer(telegram); };
    return model;
  }
  void answer(const Bytes& telegram) {
    const auto reply = [&] {
      const std::lock_guard lock(mutex_);
      return brick_.telegram(telegram, world_of_posts_.now());
    }();
    if (!reply || silent) return;
    if (!split) return usb_.give(kNxtIn, *reply);
    ++splits;
    usb_.give(kNxtIn, {reply->begin(), reply->begin() + 2});
    usb_.give(kNxtIn, {reply->begin() + 2, reply->end()});
  }
  void turn() {
    while (!ended_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      const std::lock_guard lock(mutex_);
      const auto degrees = static_cast<std::int32_t>(std::lround(world_of_posts_.way() / kMetresPerDegree));
      brick_.turn(1, degrees);
      brick_.turn(2, degrees);
      camera_.show({world_of_posts_.post(nxtcam::kProfile)});
      ++turns;
    }
  }

  Approach world_of_posts_;
  std::mutex mutex_;  ///< of brick and camera
  emulate::NxtBrick brick_{base::Time{} - kLongAgo};
  emulate::NxtCam camera_{base::Time{} - kLongAgo};
  std::atomic<bool> ended_ = false;
  UsbipDevice usb_;
  std::thread world_;
};

class RunOnNxt : public LiveRun {
 protected:
  void SetUp() override { start("nxtcam:nxt", "nxt:usb"); }
  /// Longer than the run waits for a reply.
  bool world_goes_on() {
    return host::testing::eventually([this, until = robot.turns + 20] { return robot.turns >= until; });
  }

  NxtRobot robot;
};

TEST_F(RunOnNxt, SeesAPostWhereItIs) {
  expect_flow("standing");
  robot.drive();
  EXPECT_TRUE(arrives_at(Approach::kLength, 0.001)) << x() << run->err();
  EXPECT_TRUE(logs(",confirmed*")) << run->err();
  expect_replays();
}

TEST_F(RunOnNxt, SurvivesWhatACableAndABrickDo) {
  robot.drive();
  expect_flow("at first");
  robot.usb().halt(kNxtIn);
  expect_flow("after a stall of replies");
  robot.usb().halt(kNxtOut);
  expect_flow("after a stall of commands");
  robot.usb().hold(true);
  ASSERT_TRUE(host::testing::eventually([this] { return robot.usb().held() > 0; }));
  ASSERT_TRUE(world_goes_on()) << "while a reply is held";
  robot.usb().hold(false);
  expect_flow("after late replies");
  const int splits = robot.splits;
  robot.split = true;
  ASSERT_TRUE(host::testing::eventually([&] { return robot.splits >= splits + 5; })) << run->err();
  robot.split = false;
  expect_flow("after split replies");
  expect_replays();
}

TEST_F(RunOnNxt, TellsOfASilentBrickOnce) {
  const std::string wheels = "odometry nxt on USB is silent";
  const std::string camera = "camera nxtcam behind the NXT brick is silent";
  expect_flow("at first");
  const std::size_t wheels_before = said(wheels);  // a slow start may have looked like it
  const std::size_t camera_before = said(camera);
  robot.silent = true;
  EXPECT_TRUE(host::testing::eventually([&] { return said(wheels) > wheels_before && said(camera) > camera_before; }))
      << run->err();
  robot.silent = false;
  expect_flow("after silence");
  expect_replays();
  EXPECT_EQ(said(wheels), wheels_before + 1) << run->err();
  EXPECT_EQ(said(camera), camera_before + 1) << run->err();
}

TEST_F(RunOnNxt, SurvivesAnUnplugWithATransferInFlight) {
  robot.drive();
  expect_flow("at first");
  const std::size_t wheels_before = said(kNoWheels);  // it may have been sooner than the kernel
  const std::size_t camera_before = said(kNoCamera);
  robot.usb().hold(true);
  ASSERT_TRUE(host::testing::eventually([this] { return robot.usb().held() > 0; }));
  robot.usb().unplug();
  EXPECT_TRUE(host::testing::eventually([&] {
    return said(kNoWheels) > wheels_before && said(kNoCamera) > camera_before;
  })) << run->err();
  robot.usb().plug();
  expect_flow("after a replug");
  expect_replays();
  EXPECT_EQ(said(kNoWheels), wheels_before + 1) << run->err();
  EXPECT_EQ(said(kNoCamera), camera_before + 1) << run->err();
}

}  // namespace
}  // namespace fencepost::guest
