// A robot among posts, whose configured focal length may be wrong. Boxes are whole pixels, headings have noise.
#include "firmware/recon/localize/lens_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/recon/map.hpp"
#include "tests/firmware/recon/post_world.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// 20 frames a second.
class Turner {
 public:
  explicit Turner(double configured_over_true, double heading_noise = 0.003) : noise_(0, heading_noise) {
    sensor::CameraIntrinsics configured;
    configured.width = 316;
    configured.height = 208;
    configured.fx = configured.fy = base::Pixels2::nearest(configured_over_true * truth_.focal);
    configured.cx = base::Pixels2::nearest(157.5);
    configured.cy = base::Pixels2::nearest(103.5);
    configured.mount.x = base::Metres::nearest(truth_.ahead);
    configured.mount.z = base::Metres::nearest(truth_.height);
    configured.mount.pitch = base::Radians{0};
    camera_ = recon::make_camera_model(configured);
  }

  void look() {
    const sensor::BlobFrame frame =
        view_of_posts(posts, truth_, x, y, heading, static_cast<std::int64_t>(frames_) * 500, frames_);
    ++frames_;
    recon::WaitingFrame waiting = recon::make_waiting(frame, 0);
    const auto units = [](double value, double unit) { return static_cast<std::int32_t>(std::lround(value / unit)); };
    const recon::MapPose odometry{{units(x, 1e-5), units(y, 1e-5)},
                                  units(configured_heading() + noise_(random_), 1e-6)};
    map->add_frame(waiting, camera_, odometry, {}, {});
  }
  // By `angle` at `rate` rad/s.
  void turn(double angle, double rate = 0.8) {
    const int frames = static_cast<int>(std::fabs(angle) / rate * 20);
    for (int i = 0; i < frames; ++i) {
      heading += std::copysign(rate / 20, angle);
      if (moves) moves(0.05);
      look();
    }
  }
  [[nodiscard]] const recon::LensCheck& check() const { return map->lens_check(); }

  std::vector<RoundPost> posts = {
      {1, 1.2, 0.2, 0.05}, {2, -0.3, 1.4, 0.06}, {3, -1.0, -0.4, 0.05}, {4, 0.5, -1.1, 0.04}};
  std::function<void(double seconds)> moves;
  std::unique_ptr<recon::Map<config::Small>> map = std::make_unique<recon::Map<config::Small>>();
  double heading = 0;
  double x = 0;
  double y = 0;
  double track = 1;  // of the wheels, configured over true

 private:
  [[nodiscard]] double configured_heading() const { return heading / track; }

  TrueCamera truth_{.ahead = 0.05};
  recon::CameraModel camera_;
  std::uint32_t frames_ = 0;
  std::normal_distribution<double> noise_;
  std::mt19937 random_{5};
};

TEST(LensCheck, SaysNothingOfATrueLensInTenMinutesOfTurning) {
  Turner robot(1);
  for (int minute = 0; minute < 10; ++minute) {
    for (const double rate : {0.8, 1.5, 0.4}) {
      robot.turn(rate * 10, rate);
      EXPECT_FALSE(robot.check().wrong()) << minute;
      robot.turn(-rate * 10, rate);
      EXPECT_FALSE(robot.check().wrong()) << minute;
    }
  }
  EXPECT_NEAR(robot.check().configured_over_true(), 1, 0.03F);
}

TEST(LensCheck, FindsALensConfiguredWrongWithinTwoFullTurns) {
  for (const double configured : {1.3, 1 / 1.3, 1.45}) {
    Turner robot(configured);
    robot.turn(2 * kTurn);
    EXPECT_TRUE(robot.check().wrong()) << configured;
    EXPECT_NEAR(static_cast<double>(robot.check().configured_over_true()), configured, 0.1 * configured);
  }
}

TEST(LensCheck, AFewPerCentAreNoComplaint) {
  for (const double configured : {1.08, 1 / 1.08}) {
    Turner robot(configured);
    for (int i = 0; i < 10; ++i) robot.turn(i % 2 == 0 ? kTurn : -kTurn);
    EXPECT_FALSE(robot.check().wrong()) << configured;
  }
}

TEST(LensCheck, CannotTellWheelsFromLenses) {
  Turner robot(1);
  robot.track = 1.3;  // the wheels say 1.3 times too little
  robot.turn(2 * kTurn);
  EXPECT_TRUE(robot.check().wrong());
}

TEST(LensCheck, ARobotThatStandsLearnsNothing) {
  Turner robot(1.45);
  for (int i = 0; i < 1000; ++i) robot.look();
  EXPECT_FALSE(robot.check().wrong());
  EXPECT_EQ(robot.check().configured_over_true(), 1);
}

TEST(LensCheck, ARobotThatDrivesStraightLearnsNothing) {
  Turner robot(1.45);
  for (int i = 0; i < 400; ++i) {
    robot.x += 0.002;
    robot.look();
  }
  EXPECT_FALSE(robot.check().wrong());
}

// A thing circles around the robot while the robot turns; then it is stationary with all others.
TEST(LensCheck, WhatMovesDoesNotFoolItForEver) {
  Turner robot(1);
  double at = 0.2;
  robot.moves = [&](double seconds) {
    at += 0.3 * seconds;
    robot.posts[0].x = 1.2 * std::cos(at);
    robot.posts[0].y = 1.2 * std::sin(at);
  };
  robot.turn(5 * kTurn);
  robot.moves = nullptr;
  for (int i = 0; i < 12; ++i) robot.turn(i % 2 == 0 ? kTurn : -kTurn);
  EXPECT_FALSE(robot.check().wrong());
  EXPECT_NEAR(robot.check().configured_over_true(), 1, 0.06F);
}

TEST(LensCheck, BelievesARightLensAgain) {
  Turner robot(1);
  robot.track = 1.3;
  robot.turn(2 * kTurn);
  ASSERT_TRUE(robot.check().wrong());
  robot.track = 1;
  for (int i = 0; i < 20; ++i) robot.turn(i % 2 == 0 ? kTurn : -kTurn);
  EXPECT_FALSE(robot.check().wrong());
}

TEST(LensCheck, AnotherCalibrationIsANewOne) {
  Turner robot(1.3);
  robot.turn(2 * kTurn);
  ASSERT_TRUE(robot.check().wrong());
  robot.map->recalibrated();
  EXPECT_FALSE(robot.check().wrong());
}

// The table and the matcher that the check reads: two objects where the test says.
struct CheckedTable {
  static constexpr std::size_t kObjects = 2;
  std::array<recon::ObjectCore, kObjects> things;
  base::Time t;

  [[nodiscard]] base::Time exposure() const { return t; }
  [[nodiscard]] const std::array<recon::ObjectCore, kObjects>& objects() const { return things; }
};
struct CheckedMatcher {
  std::array<bool, 2> shown{};
  std::array<recon::Observation, 2> seen_as;

  [[nodiscard]] bool seen(std::size_t slot) const { return shown[slot]; }
  [[nodiscard]] const recon::Observation& observation_of(std::size_t slot) const { return seen_as[slot]; }
};

/// A circle of 0.28 m a metre ahead of the origin, seen from three places: tangents along (0.96, 0.28), no rounding.
recon::Cylinder cylinder_ahead() {
  recon::Cylinder cylinder;
  for (int i = 0; i < 3; ++i) {
    for (const recon::Vec2& side : {recon::Vec2{1, 0}, {0.6F, 0.8F}, {0.6F, -0.8F}}) {
      recon::Sighting sighting;
      sighting.axis = sighting.center = side;
      sighting.lens = recon::Vec2{1, 0} - side;
      sighting.left = {recon::rotated(side, {0.96F, 0.28F}), recon::End::kSeen};
      sighting.right = {recon::rotated(side, {0.96F, -0.28F}), recon::End::kSeen};
      sighting.focal = 256;
      cylinder.add(sighting, {}, 1, {});
      cylinder.solve(sighting.lens, side, {});
    }
  }
  return cylinder;
}

// All that the check keeps, after each frame of a robot that turns by whole steps at rates that are its bounds. Two
// objects move across the image as they should, too little, too much, or not at all.
TEST(LensCheck, OfTurnsThatAreItsBounds) {
  Draw draw(121);
  Sweep sweep;
  sensor::CameraIntrinsics configured;
  configured.width = 316;
  configured.height = 208;
  configured.fx = configured.fy = base::Pixels2::nearest(256);
  configured.cx = base::Pixels2::nearest(157.5);
  configured.cy = base::Pixels2::nearest(103.5);
  configured.mount.x = base::Metres::nearest(0.0625);
  const recon::CameraModel camera = recon::make_camera_model(configured);
  const recon::Cylinder cylinder = cylinder_ahead();
  ASSERT_TRUE(cylinder.estimate().ok());
  for (int run = 0; run < 60; ++run) {
    CheckedTable table;
    CheckedMatcher matcher;
    recon::LensCheck check;
    for (std::size_t o = 0; o < 2; ++o) {
      table.things[o].id = static_cast<std::uint32_t>(o + 1);
      table.things[o].cylinder = cylinder;
      table.things[o].origin = {draw.of({0, 0, -70'000, -60'000, 50'000}), 0};
    }
    const float scale = draw.of({1.0F, 1.0F, 1.25F, 0.8F, 0.4F, 2.5F, 0.25F, 4.0F});
    const int ticks = draw.of({500, 1'000, 5'000});
    recon::MapPose odometry;
    table.t = {100'000};
    float column = 157;
    for (int frame = 0; frame < 160; ++frame) {
      const int rate = draw.one_in(8) ? draw.of({14, 15, 16, -15, 0}) : draw.of({75, 75, 75, 150, 150, 300, -150});
      const int turned = draw.one_in(6) ? draw.of({150'000, 149'999, 150'001}) : rate * ticks;
      odometry.heading += turned;
      if (draw.one_in(10)) odometry.heading -= 6'283'185;
      if (draw.one_in(6)) odometry.position.x += draw.of({1'000, 10'000, 20'000, -20'000, 50'000, -50'000});
      table.t = table.t + base::Duration{draw.one_in(20) ? draw.of({0, 4'999, 5'000, 5'001, -1}) : ticks};
      column += scale * 256 * 1e-6F * static_cast<float>(turned) + (draw.one_in(6) ? draw.steps(-20, 20, 1) : 0.0F);
      if (column < 20 || column > 290) column = draw.steps(20, 290, 1);
      for (std::size_t o = 0; o < 2; ++o) {
        recon::ObjectCore& thing = table.things[o];
        thing.confirmed = !draw.one_in(20);
        thing.left = draw.one_in(20) ? recon::End::kLowerBound : recon::End::kSeen;
        thing.right = draw.one_in(20) ? recon::End::kLowerBound : recon::End::kAmbiguous;
        thing.relocations = draw.one_in(20) ? 0 : 1;
        if (draw.one_in(30)) thing.id += 2;
        matcher.shown[o] = !draw.one_in(20);
        const auto u = static_cast<std::int16_t>(column);
        matcher.seen_as[o].box = {static_cast<std::int16_t>(u - 10), 90, static_cast<std::int16_t>(u + 10),
                                  draw.of<std::int16_t>({120, 121})};
      }
      check.look(table, matcher, camera, recon::lens_pose(odometry, camera), odometry);
      base::Fnv1a64 hash;
      for (std::uint32_t part = 0; part < 4; ++part) check.hash(hash, part);
      sweep.tell("digest", static_cast<std::uint32_t>(hash.value()));
      sweep.tell("wrong", check.wrong());
      sweep.tell("error", check.error().value_or(0));
      sweep.tell("configured over true", check.configured_over_true());
    }
    check.clear();
    sweep.tell("cleared", check.wrong());
  }
  expect_said(sweep, {"digest 9600 f3b1fb96", "wrong 703 28043e5e", "error 703 09aa2d59",
                      "configured over true 9600 ce50bdbb", "cleared 0 818c1c65"});
}

/// Looks at one object a metre ahead while the robot turns on, 0.075 rad a frame of 0.1 s.
struct OneThing {
  OneThing() {
    sensor::CameraIntrinsics configured;
    configured.width = 316;
    configured.height = 208;
    configured.fx = configured.fy = base::Pixels2::nearest(256);
    configured.cx = base::Pixels2::nearest(157.5);
    configured.cy = base::Pixels2::nearest(103.5);
    camera = recon::make_camera_model(configured);
    recon::ObjectCore& thing = table.things[0];
    thing.id = 1;
    thing.cylinder = cylinder_ahead();
    thing.confirmed = true;
    thing.left = thing.right = recon::End::kSeen;
    thing.relocations = 1;
    table.t = {100'000};
  }
  void look(int column, bool shown = true) {
    table.t = table.t + base::milliseconds(100);
    odometry.heading += 75'000;
    matcher.shown[0] = shown;
    matcher.seen_as[0].box = {static_cast<std::int16_t>(column - 10), 90, static_cast<std::int16_t>(column + 10), 120};
    check.look(table, matcher, camera, recon::lens_pose(odometry, camera), odometry);
  }

  CheckedTable table;
  CheckedMatcher matcher;
  recon::CameraModel camera;
  recon::MapPose odometry;
  recon::LensCheck check;
};

TEST(LensCheck, WhatTheRobotHasPassedTellsNothing) {
  for (const bool passed : {false, true}) {
    OneThing robot;
    robot.look(157);
    robot.look(157);  // it turns: the thing is followed from here
    const double heading = 1e-6 * robot.odometry.heading;
    robot.look(176);
    if (passed) {  // 2.5 m straight on, as it looked then
      robot.odometry.position = {static_cast<std::int32_t>(250'000 * (1 - heading * heading / 2)),
                                 static_cast<std::int32_t>(250'000 * (heading - heading * heading * heading / 6))};
    }
    robot.look(195);
    EXPECT_EQ(robot.check.configured_over_true() == 1, passed);
  }
}

// Half is forgotten at 64 samples: the estimate stays.
TEST(LensCheck, StaysSureAfterHundredsOfSamples) {
  OneThing robot;
  for (int i = 0; i < 900; ++i) {
    robot.look(157 + 16 * (i % 6), i % 6 != 5);  // 16 columns where 19 would be right
    if (i > 60) {
      ASSERT_TRUE(robot.check.wrong()) << i;
      ASSERT_NEAR(robot.check.configured_over_true(), 1.21F, 0.02F);
    }
  }
}

}  // namespace
}  // namespace fencepost::test
