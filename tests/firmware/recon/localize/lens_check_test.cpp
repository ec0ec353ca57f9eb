// A robot among posts, whose map is told a focal length that may be wrong. Boxes are whole pixels, headings have noise.
#include "firmware/recon/localize/lens_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/recon/map.hpp"
#include "tests/firmware/recon/post_world.hpp"

namespace fencepost::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// 20 frames a second.
class Turner {
 public:
  explicit Turner(double told_over_true, double heading_noise = 0.003) : noise_(0, heading_noise) {
    sensor::CameraIntrinsics told;
    told.width = 316;
    told.height = 208;
    told.fx = told.fy = base::Pixels2::nearest(told_over_true * truth_.focal);
    told.cx = base::Pixels2::nearest(157.5);
    told.cy = base::Pixels2::nearest(103.5);
    told.mount.x = base::Metres::nearest(truth_.ahead);
    told.mount.z = base::Metres::nearest(truth_.height);
    told.mount.pitch = base::Radians{0};
    camera_ = recon::make_camera_model(told);
  }

  void look() {
    const sensor::BlobFrame frame =
        view_of_posts(posts, truth_, x, y, heading, static_cast<std::int64_t>(frames_) * 500, frames_);
    ++frames_;
    recon::WaitingFrame waiting = recon::make_waiting(frame, 0);
    const auto units = [](double value, double unit) { return static_cast<std::int32_t>(std::lround(value / unit)); };
    const recon::MapPose odometry{{units(x, 1e-5), units(y, 1e-5)}, units(told_heading() + noise_(random_), 1e-6)};
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
  double track = 1;  // of the wheels, told over true

 private:
  [[nodiscard]] double told_heading() const { return heading / track; }

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
  EXPECT_NEAR(robot.check().told_over_true(), 1, 0.03F);
}

TEST(LensCheck, FindsALensToldWrongWithinTwoFullTurns) {
  for (const double told : {1.3, 1 / 1.3, 1.45}) {
    Turner robot(told);
    robot.turn(2 * kTurn);
    EXPECT_TRUE(robot.check().wrong()) << told;
    EXPECT_NEAR(static_cast<double>(robot.check().told_over_true()), told, 0.1 * told);
  }
}

TEST(LensCheck, AFewPerCentAreNoComplaint) {
  for (const double told : {1.08, 1 / 1.08}) {
    Turner robot(told);
    for (int i = 0; i < 10; ++i) robot.turn(i % 2 == 0 ? kTurn : -kTurn);
    EXPECT_FALSE(robot.check().wrong()) << told;
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
  EXPECT_EQ(robot.check().told_over_true(), 1);
}

TEST(LensCheck, ARobotThatDrivesStraightLearnsNothing) {
  Turner robot(1.45);
  for (int i = 0; i < 400; ++i) {
    robot.x += 0.002;
    robot.look();
  }
  EXPECT_FALSE(robot.check().wrong());
}

// A thing that circles around the robot while that turns; then it stands with all others.
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
  EXPECT_NEAR(robot.check().told_over_true(), 1, 0.06F);
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

}  // namespace
}  // namespace fencepost::test
