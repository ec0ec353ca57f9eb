// A ball comes closer by itself in a whole run. Stop is said in time, whatever the console's mode, and while odometry
// is silent.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>

#include "firmware/loop/pipeline.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

/// A stationary robot at which a ball rolls. Odometry at 50 samples a second, frames at 25.
template <class Profile>
class RollingBall {
 public:
  explicit RollingBall(console::Mode mode, double speed) : pipeline(*memory, mode), speed_(speed) {
    pipeline.start_run(header_);
    pipeline.set_camera(level_pixy2());
    pipeline.set_signature({1, {0xd0, 0x20, 0x20}, "red"});
  }

  /// Runs until `before` seconds before it touches the body, 0.1 m from the origin.
  void until(double before, bool odometry = true) {
    while ((away() - 0.1) / speed_ > before) {
      t_ += 0.02;
      ++turn_;
      if (odometry) pipeline.accept(sensor::OdometrySample{base::Time::nearest(t_), {}, {}, {}});
      if (turn_ % 2 == 0) {
        const double seen = kFar - speed_ * (t_ - 0.05);
        pipeline.accept(flat_view({{seen, -0.04, 0.04}}, 0, 0, t_, static_cast<std::uint32_t>(turn_ / 2)));
      }
      while (pipeline.place_next_frame()) {
      }
      pipeline.watch_without_frames();
      const std::span<const char> lines = memory->output.waiting();
      said.append(lines.data(), lines.size());
      memory->output.taken(lines.size());
    }
  }
  [[nodiscard]] AlertLevel level() const {
    AlertLevel level = memory->front_alert.level;
    for (const alert::AlertState& state : memory->alerts) level = std::max(level, state.level);
    return level;
  }

  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline;
  std::string said;

 private:
  static constexpr double kFar = 2.5;
  [[nodiscard]] double away() const { return kFar - speed_ * t_; }

  double speed_;
  double t_ = 0;
  int turn_ = 0;
  record::Header header_{1, "fencepost", "0.0.0", "test", Profile::kName};
};

template <class Profile>
class LoomingAlert : public testing::Test {};
using Profiles = testing::Types<config::Micro, config::Small, config::Full>;
TYPED_TEST_SUITE(LoomingAlert, Profiles);

TYPED_TEST(LoomingAlert, StopsAStandingRobotInAllModes) {
  for (const console::Mode mode :
       {console::Mode::kQuiet, console::Mode::kText, console::Mode::kLog, console::Mode::kPlot}) {
    for (const double speed : {0.3, 0.6, 1.0, 1.5}) {
      RollingBall<TypeParam> ball(mode, speed);
      ball.until(2);
      EXPECT_LT(ball.level(), AlertLevel::kStop) << speed << " m/s";
      ball.until(0.6);
      for (double before = 0.6; before >= 0; before -= 0.05) {
        ball.until(before);
        EXPECT_EQ(ball.level(), AlertLevel::kStop) << speed << " m/s, " << before << " s before";
      }
      const std::string_view word = mode == console::Mode::kText   ? "STOP"
                                    : mode == console::Mode::kLog  ? ",stop,"
                                    : mode == console::Mode::kPlot ? "level:3"
                                                                   : "";
      EXPECT_NE(ball.said.find(word), std::string::npos) << speed << " m/s: " << ball.said;
    }
  }
}

// It stands and is blind by odometry only after a second; until then the growth of the box alone says stop.
TYPED_TEST(LoomingAlert, NeedsNoOdometry) {
  RollingBall<TypeParam> ball(console::Mode::kText, 1.0);
  ball.until(1.6);
  ASSERT_LT(ball.level(), AlertLevel::kStop);
  ball.until(0.6, false);
  EXPECT_EQ(ball.level(), AlertLevel::kStop) << ball.said;
}

// A restart clears the stop that was in force: the robot may go on.
TYPED_TEST(LoomingAlert, EndsWithARun) {
  RollingBall<TypeParam> ball(console::Mode::kQuiet, 1.0);
  ball.until(0.5);
  ASSERT_EQ(ball.level(), AlertLevel::kStop);
  ball.pipeline.restart();
  EXPECT_EQ(ball.level(), AlertLevel::kClear);
  for (const alert::LoomingTrack& track : ball.memory->looming.tracks()) EXPECT_FALSE(track.used());
}

/// A robot and one thing, both at constant speed; the highest level said, and the objects that the map has in the end.
template <class Profile>
struct Passing {
  Passing(double robot_speed, double x, double y, double speed_x, double speed_y, double seconds) {
    pipeline.start_run(header);
    pipeline.set_camera(level_pixy2());
    for (int i = 1; i * 0.02 < seconds; ++i) {
      const double t = i * 0.02;
      pipeline.accept(sensor::OdometrySample{base::Time::nearest(t), base::Metres::nearest(robot_speed * t), {}, {}});
      const double seen = t - 0.05;
      // Boxes that stay exactly as they are would be a frozen camera's.
      const double side = y + speed_y * seen + (i % 8 < 4 ? 0.004 : -0.004);
      if (i % 2 == 0) {
        const FlatFront front{x + speed_x * seen, side - 0.05, side + 0.05};
        pipeline.accept(flat_view({front}, robot_speed * seen, 0, t, static_cast<std::uint32_t>(i)));
      }
      while (pipeline.place_next_frame()) {
      }
      pipeline.watch_without_frames();
      highest = std::max(highest, memory->front_alert.level);
      for (const alert::AlertState& state : memory->alerts) highest = std::max(highest, state.level);
    }
    for (const auto& object : memory->map.slots()) objects += object.used() && object.confirmed ? 1 : 0;
  }
  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline{*memory, console::Mode::kQuiet};
  record::Header header{1, "fencepost", "0.0.0", "test", Profile::kName};
  AlertLevel highest = AlertLevel::kClear;
  int objects = 0;
};

// It is one object that goes with it, and leaves no points behind.
TYPED_TEST(LoomingAlert, ALeaderAtEqualSpeedDoesNotStopTheRobot) {
  for (const double speed : {0.1, 0.2, 0.3}) {
    const Passing<TypeParam> leader(speed, 0.5, 0, speed, 0, 10);
    EXPECT_LT(leader.highest, AlertLevel::kStop) << speed << " m/s";
    EXPECT_EQ(leader.objects, 1) << speed << " m/s";
    for (const auto& object : leader.memory->map.slots()) {
      if (!object.used() || !object.cylinder.estimate().ok()) continue;
      const double x = object.origin.x * 1e-5 + static_cast<double>(object.cylinder.estimate().center.x());
      EXPECT_NEAR(x, 0.5 + 10 * speed, 0.15) << speed << " m/s";
    }
  }
}

TYPED_TEST(LoomingAlert, WhatCrossesLeavesOneObjectAtMost) {
  for (const double speed : {0.3, 0.6}) {
    const Passing<TypeParam> ball(0, 0.9, 1.0, 0, -speed, 2.0 / speed);
    EXPECT_LT(ball.highest, AlertLevel::kStop) << speed << " m/s";
    EXPECT_LE(ball.objects, 1) << speed << " m/s";
  }
}

// A stationary post is not taken for a mover, however the robot drives at it.
TYPED_TEST(LoomingAlert, APostThatIsPassedStaysInTheMap) {
  for (const double speed : {0.1, 0.3}) {
    const Passing<TypeParam> post(speed, 1.5, 0.3, 0, 0, 0.8 / speed);
    EXPECT_EQ(post.objects, 1) << speed << " m/s";
    for (const auto& object : post.memory->map.slots()) {
      if (!object.used()) continue;
      EXPECT_FALSE(object.moving) << speed << " m/s";
      EXPECT_GT(object.views, 20U) << speed << " m/s";
    }
  }
}

}  // namespace
}  // namespace fencepost::test
