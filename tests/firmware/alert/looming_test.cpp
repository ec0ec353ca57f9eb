#include "firmware/alert/looming.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "hal/base/trig.hpp"
#include "tests/firmware/level_pixy2.hpp"

namespace fencepost::test {
namespace {

using alert::FrontAhead;
using record::AlertLevel;

/// Something with a flat front towards the robot, map frame, m and m/s.
struct Thing {
  double x = 1;
  double y = 0;
  double speed_x = 0;
  double speed_y = 0;
  double width = 0.1;
  double height = 0.1;
  std::uint8_t signature = 1;
  double base = 0;  // of its foot above the floor
};

constexpr double kRate = 25;
constexpr double kBody = 0.1;  // m, RobotPath's

/// A robot that looks at things which move straight; frames without latency.
class Looks : public testing::Test {
 protected:
  explicit Looks() { use(level_pixy2(0)); }

  void use(const sensor::CameraIntrinsics& intrinsics) {
    camera_ = recon::make_camera_model(intrinsics);
    looming_.clear();
  }

  /// Shows the next frame and returns the alert due then.
  FrontAhead look(bool lit = true) {
    t_ += 1 / kRate;
    heading_ += turn_ / kRate;
    robot_x_ += speed_ * std::cos(heading_) / kRate;
    robot_y_ += speed_ * std::sin(heading_) / kRate;
    recon::WaitingFrame frame;
    frame.t = base::Time::nearest(t_);
    for (Thing& thing : things_) {
      thing.x += thing.speed_x / kRate;
      thing.y += thing.speed_y / kRate;
      const std::optional<recon::WaitingBlob> blob = lit ? seen(thing) : std::nullopt;
      if (blob) static_cast<void>(frame.blobs.push_back(*blob));
    }
    std::stable_sort(frame.blobs.begin(), frame.blobs.end(), [](const auto& a, const auto& b) {
      return a.signature != b.signature ? a.signature < b.signature : a.box.x1 < b.box.x1;
    });
    recon::MapPose pose;
    pose.position = {static_cast<std::int32_t>(std::lround(robot_x_ * 1e5)),
                     static_cast<std::int32_t>(std::lround(robot_y_ * 1e5))};
    pose.heading = static_cast<std::int32_t>(std::lround(std::remainder(heading_, 2 * M_PI) * 1e6));
    looming_.look(frame, camera_, odometry_ ? &pose : nullptr);
    marked_ = std::any_of(frame.blobs.begin(), frame.blobs.end(), [](const auto& blob) { return blob.moves; });
    path_.motion = {static_cast<float>(odometry_ ? speed_ : 0), static_cast<float>(turn_)};
    return looming_.ahead(camera_, path_, rules_, base::Time::nearest(t_));
  }

  /// The highest level that is due within the next `seconds`.
  AlertLevel highest(double seconds) {
    AlertLevel level = AlertLevel::kClear;
    for (int i = 0; i < std::lround(seconds * kRate); ++i) level = std::max(level, look().due);
    return level;
  }

  /// s before the first thing touches the body at which stop is due from then on; less than 0: it is not at the end.
  double announced() {
    double since = -1;
    double now = 0;
    for (;;) {
      const Thing& thing = things_.front();
      const double left = std::hypot(thing.x - robot_x_, thing.y - robot_y_) - kBody;
      if (left <= 0 || now > 30) return since < 0 ? since : now - since;
      const bool stop = look().due == AlertLevel::kStop;
      if (!stop) since = -1;
      if (stop && since < 0) since = now;
      now += 1 / kRate;
    }
  }

  std::vector<Thing> things_;
  alert::Looming<8> looming_;
  double speed_ = 0;
  double turn_ = 0;
  double heading_ = 0;
  double robot_x_ = 0;
  double robot_y_ = 0;
  bool odometry_ = true;
  bool marked_ = false;  ///< a blob of the last frame, as of something that moves
  double noise_ = 1;     // px, of each edge
  alert::RobotPath path_;
  recon::CameraModel camera_;
  alert::AlertRules rules_{config::Settings{}};

 private:
  std::int16_t edge(double at, int last) {
    const double noisy = at <= 0 || at >= last ? at : at + noise_ * gauss_(random_);
    return static_cast<std::int16_t>(std::lround(std::clamp(noisy, 0.0, double(last))));
  }
  std::optional<recon::WaitingBlob> seen(const Thing& thing) {
    const double dx = thing.x - robot_x_;
    const double dy = thing.y - robot_y_;
    const double depth = std::cos(heading_) * dx + std::sin(heading_) * dy;
    const double left = std::cos(heading_) * dy - std::sin(heading_) * dx;
    if (depth < 0.02) return std::nullopt;
    const double f = static_cast<double>(camera_.fx);
    const double h = static_cast<double>(camera_.height);
    const double u1 = 157.5 - f * (left + thing.width / 2) / depth;
    const double u2 = 157.5 - f * (left - thing.width / 2) / depth;
    const double top = 103.5 + f * (h - thing.height) / depth;
    const double foot = 103.5 + f * (h - thing.base) / depth;
    if (u2 < 2 || u1 > 313 || top > 205) return std::nullopt;
    recon::WaitingBlob blob;
    blob.signature = thing.signature;
    blob.box = {edge(u1 + 0.5, 315), edge(top + 0.5, 207), edge(u2 - 0.5, 315), edge(foot - 0.5, 207)};
    blob.box.x2 = std::max(blob.box.x1, blob.box.x2);
    blob.box.y2 = std::max(blob.box.y1, blob.box.y2);
    return blob;
  }

  double t_ = 100;
  std::minstd_rand random_{1};
  std::normal_distribution<double> gauss_;
};

/// A thing that is seen once, and then frames without it; times are in 10^-4 s.
struct Unseen {
  explicit Unseen(const recon::CameraModel& model) : camera(model) {
    recon::WaitingFrame frame;
    frame.t = t;
    static_cast<void>(frame.blobs.push_back({{150, 90, 180, 160}, 1, false}));
    looming.look(frame, camera, nullptr);
  }
  const alert::LoomingTrack& after(std::int64_t span) {
    recon::WaitingFrame frame;
    frame.t = t = t + base::Duration{span};
    looming.look(frame, camera, nullptr);
    return looming.tracks()[0];
  }
  recon::CameraModel camera;
  base::Time t{1'000'000};
  alert::Looming<8> looming;
};

// 2^-10 and 2^-6 s: 166 of 10^-4 s are 16.99 of the first, 1035 are 105.98.
TEST_F(Looks, CountsTimeInPartsOfASecond) {
  EXPECT_EQ(Unseen(camera_).after(400).unseen, 40);
  EXPECT_EQ(Unseen(camera_).after(166).unseen, 16);
  EXPECT_EQ(Unseen(camera_).after(1'035).unseen, 105);
  Unseen several(camera_);
  ASSERT_TRUE(several.after(400).used());
  EXPECT_EQ(several.after(400).unseen, 80);
  EXPECT_EQ(Unseen(camera_).after(400).unmeasured, 2);
  EXPECT_EQ(Unseen(camera_).after(1'000).unmeasured, 6);
  Unseen quick(camera_);
  EXPECT_EQ(quick.after(50).unmeasured, 1) << "one a frame, at least";
  EXPECT_EQ(quick.after(50).unmeasured, 2);
}

// Cut at both sides and below it has no distance: after two seconds it is no track.
TEST_F(Looks, WhatIsNotMeasuredIsForgotten) {
  Unseen wide(camera_);
  const auto used_after = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds * kRate); ++i) {
      recon::WaitingFrame frame;
      frame.t = wide.t = wide.t + base::Duration{400};
      static_cast<void>(frame.blobs.push_back({{0, 90, 315, 207}, 1, false}));
      wide.looming.look(frame, camera_, nullptr);
    }
    return wide.looming.tracks()[0].used();
  };
  EXPECT_TRUE(used_after(1.96));
  EXPECT_FALSE(used_after(0.8));
}

// Nearer by far than anything can come in a frame, once: then it is where it was.
TEST_F(Looks, AStrayThatStaysAloneIsForgotten) {
  noise_ = 0;
  things_ = {{1.0, 0, 0, 0, 0.1, 0.1}};
  for (int i = 0; i < 10; ++i) look();
  ASSERT_TRUE(looming_.tracks()[0].used());
  const std::uint16_t depth = looming_.tracks()[0].depth;
  for (int times = 0; times < 4; ++times) {
    things_[0].x = 0.5;
    look();
    EXPECT_EQ(looming_.tracks()[0].strays, 1) << times;
    things_[0].x = 1.0;
    look();
    EXPECT_EQ(looming_.tracks()[0].strays, 0) << times;
  }
  EXPECT_NEAR(looming_.tracks()[0].depth, depth, 160) << "1 cm";
}

TEST_F(Looks, ABallIsAnnouncedAndStaysSo) {
  for (const double speed : {0.3, 0.5, 1.0, 1.5}) {
    for (const double aside : {-0.3, 0.0, 0.3}) {
      looming_.clear();
      const double far = 2.5;
      things_ = {{far, aside * far, -speed, -aside * speed}};
      const double ahead = announced();
      EXPECT_GE(ahead, 0.75) << speed << " m/s, " << aside;
      EXPECT_LE(ahead, 1.6) << speed << " m/s, " << aside;
    }
  }
}

TEST_F(Looks, TellsWhereAndHowSoon) {
  things_ = {{2.0, 0.1, -0.5, 0, 0.1, 0.1, 3}};
  FrontAhead front;
  while (front.due != AlertLevel::kStop) front = look();
  ASSERT_TRUE(front.nearest.known && front.nearest.closing);
  EXPECT_EQ(front.signature, 3);
  const double distance = std::hypot(things_[0].x, things_[0].y);
  EXPECT_NEAR(front.nearest.distance, distance, 0.05);
  EXPECT_NEAR(front.nearest.bearing(), std::atan2(0.1, things_[0].x), 0.05);
  EXPECT_NEAR(front.nearest.closing_speed, 0.5, 0.1);
  EXPECT_NEAR(front.nearest.ttc, (distance - kBody) / 0.5, 0.2);
  EXPECT_GT(front.confidence, 0.5F);
}

TEST_F(Looks, TheTwoThresholds) {
  things_ = {{2.5, 0, -0.5, 0}};
  EXPECT_EQ(highest(1.8), AlertLevel::kClear) << "it is 1.6 m away, 3 s";
  EXPECT_EQ(highest(1.1), AlertLevel::kWarn) << "1.05 m, 1.9 s";
  EXPECT_EQ(highest(0.9), AlertLevel::kStop) << "0.6 m, 1 s";
}

TEST_F(Looks, WhatGoesAwayIsNothing) {
  things_ = {{0.5, 0, 0.3, 0}};
  EXPECT_EQ(highest(5), AlertLevel::kClear);
}

TEST_F(Looks, ALeaderAtEqualSpeedIsNothing) {
  things_ = {{0.6, 0, 0.3, 0, 0.2}};
  speed_ = 0.3;
  EXPECT_EQ(highest(20), AlertLevel::kClear);
}

TEST_F(Looks, ALeaderThatComesBackStops) {
  things_ = {{1.5, 0, 0.2, 0, 0.2}};
  speed_ = 0.2;
  ASSERT_EQ(highest(3), AlertLevel::kClear);
  things_[0].speed_x = -0.3;
  EXPECT_GE(announced(), 0.6);
}

TEST_F(Looks, AnOncomingRobotIsMetAtBothSpeeds) {
  things_ = {{2.5, 0, -0.3, 0, 0.2, 0.15}};
  speed_ = 0.3;
  const double ahead = announced();
  EXPECT_GE(ahead, 0.7);
  EXPECT_LE(ahead, 1.4);
}

TEST_F(Looks, WhatCrossesIsNothing) {
  for (const double speed : {0.3, 0.6, 1.0}) {
    things_ = {{0.9, 1.5, 0, -speed}};
    EXPECT_EQ(highest(3 / speed), AlertLevel::kClear) << speed;
  }
}

// It comes closer, but will pass beside: constant bearing alone is a collision.
TEST_F(Looks, WhatPassesBesideIsNothing) {
  things_ = {{2.5, 0.45, -0.5, 0}};
  EXPECT_EQ(highest(6), AlertLevel::kClear);
  looming_.clear();
  things_ = {{2.5, 0.13, -0.5, 0}};
  EXPECT_EQ(highest(6), AlertLevel::kStop) << "its edge touches the margin";
}

TEST_F(Looks, NoiseIsNothingWhenAllStand) {
  noise_ = 1.5;
  things_ = {
      {0.35, 0, 0, 0}, {0.6, 0.15, 0, 0, 0.1, 0.1, 2}, {1.2, -0.3, 0, 0, 0.2, 0.1, 3}, {2.5, 0.5, 0, 0, 0.1, 0.1, 4}};
  EXPECT_EQ(highest(600), AlertLevel::kClear);
}

TEST_F(Looks, DrivingTowardsAPostSaysNothingOfItsOwn) {
  for (const double speed : {0.1, 0.3, 0.5}) {
    looming_.clear();
    robot_x_ = 0;
    things_ = {{2.6, 0.05, 0, 0}, {2.0, 0.3, 0, 0, 0.1, 0.1, 2}};
    speed_ = speed;
    EXPECT_EQ(highest(2.4 / speed), AlertLevel::kClear) << speed;
  }
}

// A foot above the floor seems to move with the robot: that is the robot's motion, not its own.
TEST_F(Looks, AFootABitAboveTheFloorDoesNotMove) {
  things_ = {{2.4, 0, 0, 0}};
  things_[0].base = 0.02;
  speed_ = 0.3;
  EXPECT_EQ(highest(6), AlertLevel::kClear);
}

TEST_F(Looks, OdometrySilentTheBallIsAnnouncedAllTheSame) {
  odometry_ = false;
  things_ = {{2.5, 0, -0.8, 0}};
  EXPECT_GE(announced(), 0.75);
  EXPECT_EQ(highest(1), AlertLevel::kStop) << "below the image";
}

// Then it is the robot that moves, but nobody knows: contact is as near.
TEST_F(Looks, OdometrySilentAPostCounts) {
  odometry_ = false;
  speed_ = 0.4;
  things_ = {{2.0, 0, 0, 0}};
  EXPECT_GE(announced(), 0.75);
}

// While odometry was silent it was unknown who moved. A stationary post must keep its place on the floor meanwhile, or
// nothing at all reports it.
TEST_F(Looks, OdometryBackAPostStandsAgain) {
  things_ = {{.x = 1.6}};
  speed_ = 0.3;
  odometry_ = false;
  for (int i = 0; i < 3 * kRate; ++i) static_cast<void>(look());
  EXPECT_FALSE(marked_) << "without odometry nothing is known to move";
  odometry_ = true;
  for (int i = 0; i < kRate; ++i) {
    static_cast<void>(look());
    EXPECT_FALSE(marked_) << i;
  }
}

TEST_F(Looks, GrowthAloneTellsHowSoon) {
  sensor::CameraIntrinsics intrinsics = level_pixy2(0);
  intrinsics.mount.pitch.reset();
  use(intrinsics);
  things_ = {{2.5, 0, -0.8, 0, 0.25}};
  EXPECT_GE(announced(), 0.6);
  things_ = {{1.5, 0, 0, 0, 0.25}};
  looming_.clear();
  EXPECT_EQ(highest(60), AlertLevel::kClear) << "it stands";
  speed_ = 0.3;
  EXPECT_EQ(highest(3), AlertLevel::kClear) << "and without a scale nothing moves that the robot drives at";
}

// Two of one colour roll to and fro and pass one another: each goes its way across.
TEST_F(Looks, TwoThatSwapPlacesAreNothing) {
  things_ = {{0.9, -0.3, 0, 0.2}, {1.3, 0.3, 0, -0.2}};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(highest(3), AlertLevel::kClear) << i;
    for (Thing& thing : things_) thing.speed_y = -thing.speed_y;
  }
}

TEST_F(Looks, ABoxThatTheBorderCutsDoesNotCome) {
  things_ = {{0.8, 0.45, 0, 0, 0.3, 0.2}, {0.25, -0.05, 0, 0, 0.1, 0.1, 2}};
  speed_ = 0.02;
  EXPECT_EQ(highest(5), AlertLevel::kClear);
}

// Its foot leaves the image at 0.32 m, its top at 0.09: it comes on all the same.
TEST_F(Looks, StaysInForceBelowTheImage) {
  things_ = {{1.5, 0, -0.3, 0, 0.08, 0.04}};
  EXPECT_GE(announced(), 0.75);
}

TEST_F(Looks, IsForgottenWhenItIsGone) {
  things_ = {{1.5, 0, -1.0, 0}};
  ASSERT_EQ(highest(0.7), AlertLevel::kStop);
  things_.clear();
  highest(0.4);
  EXPECT_EQ(highest(3), AlertLevel::kClear);
}

// Turning on the spot through the seam of the heading, many times.
TEST_F(Looks, TheHeadingMayWrap) {
  heading_ = 3.0;
  turn_ = 1.0;
  noise_ = 0.5;
  things_ = {{-0.8, 0, 0, 0}, {0.9, 0.2, 0, 0}};
  EXPECT_EQ(highest(60), AlertLevel::kClear);
  turn_ = 0;
  heading_ = M_PI - 0.01;
  looming_.clear();
  things_ = {{-2.5, 0, 0.6, 0}};
  for (int i = 0; i < 20; ++i) {  // to and fro over the seam
    turn_ = i % 2 == 0 ? 0.5 : -0.5;
    look();
  }
  turn_ = 0;
  EXPECT_GE(announced(), 0.7);
}

TEST_F(Looks, AFullTableKeepsWhatIsNear) {
  things_.clear();
  for (int i = 0; i < 8; ++i) things_.push_back({2.5, -0.8 + 0.2 * i, 0, 0, 0.08, 0.1, 2});
  highest(1);
  things_.push_back({1.6, 0.02, -0.5, 0});
  std::rotate(things_.begin(), things_.end() - 1, things_.end());
  EXPECT_GE(announced(), 0.7);
}

}  // namespace
}  // namespace fencepost::test
