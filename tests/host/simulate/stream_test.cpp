// Times, order and repetition of the records; the paths; what a robot's log must look like.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

constexpr double kPi = std::numbers::pi;

struct Stream : testing::Test {
  Scene scene = empty_scene();
};
using Paths = Stream;

TEST_F(Stream, StartsWithHeaderCameraAndSignatures) {
  scene.path = standing(0, 0, 0);
  const Simulated simulated = run(scene);
  ASSERT_GE(simulated.log.order.size(), 6U);
  EXPECT_EQ(std::string(simulated.log.order.begin(), simulated.log.order.begin() + 6), "HCSSSO");
  EXPECT_EQ(simulated.log.headers[0].target.view(), "simulator");
  EXPECT_EQ(simulated.log.headers[0].product.view(), "fencepost");
  EXPECT_EQ(simulated.log.headers[0].profile.view(), "full");
  EXPECT_EQ(simulated.log.cameras[0], scene.camera);
  EXPECT_EQ(simulated.log.signatures[1].name.view(), "blue");
}

TEST_F(Stream, FramesArriveALatencyAfterTheirExposure) {
  scene.rate = 30;
  scene.camera.latency = base::Duration::nearest(0.0456);
  scene.path = standing(0, 0, 0, 31, 30);
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.log.frames.size(), 31U);
  EXPECT_EQ(simulated.log.frames[0].t.raw, 456);
  EXPECT_EQ(simulated.log.frames[1].t.raw, 333 + 456);  // 1/30 s rounds to 0.0333
  EXPECT_EQ(simulated.log.frames[2].t.raw, 667 + 456);
  EXPECT_EQ(simulated.log.frames[30].t.raw, 10'000 + 456);
  EXPECT_EQ(simulated.log.frames[30].frame, 30U);
  EXPECT_EQ(simulated.truth[1].exposure.raw, 333);
}

TEST_F(Stream, OdometryIsAt50HzAndReachesPastTheLastFrame) {
  scene.rate = 7;
  scene.camera.latency = base::Duration::nearest(0.1);
  scene.path = standing(0, 0, 0, 8, 7);
  const Simulated simulated = run(scene);
  for (std::size_t i = 0; i < simulated.log.odometry.size(); ++i) {
    ASSERT_EQ(simulated.log.odometry[i].t.raw, static_cast<std::int64_t>(i) * 200);
  }
  EXPECT_GE(simulated.log.odometry.back().t, simulated.log.frames.back().t);
  EXPECT_EQ(simulated.summary.odometry, simulated.log.odometry.size());
  EXPECT_EQ(simulated.summary.duration, simulated.log.odometry.back().t.to_double());
}

TEST_F(Stream, RecordsComeInOrderOfArrivalOdometryFirst) {
  scene.camera.latency = base::Duration::nearest(0.04);  // exactly on an odometry sample
  scene.path = standing(0, 0, 0, 50);
  const Simulated simulated = run(scene);
  std::size_t odometry = 0;
  std::size_t frame = 0;
  for (const char kind : simulated.log.order) {
    if (kind == 'O') ++odometry;
    if (kind != 'F') continue;
    ASSERT_GT(odometry, 0U);
    EXPECT_EQ(simulated.log.odometry[odometry - 1].t, simulated.log.frames[frame].t);
    ++frame;
  }
  EXPECT_EQ(frame, 50U);
}

TEST_F(Stream, CalibrationComesAgainEveryTenSeconds) {
  scene.rate = 1;
  scene.path = standing(0, 0, 0, 26, 1);
  const Simulated simulated = run(scene);
  EXPECT_EQ(simulated.log.cameras.size(), 3U);  // 0, 10, 20 s
  EXPECT_EQ(simulated.log.signatures.size(), 9U);
  EXPECT_EQ(simulated.log.headers.size(), 1U);
}

TEST_F(Paths, ArcLooksAtItsCentreWhateverTheMount) {
  scene.rate = 10;
  scene.camera.mount.yaw = base::Radians::nearest(0.5);
  scene.path = ArcPath{{1, 2}, 1.5, 0, kPi, 5, false};
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.truth.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    const double angle = kPi * i / 4;  // evenly, both ends included
    const TimedPose& pose = simulated.truth[static_cast<std::size_t>(i)].pose;
    EXPECT_NEAR(pose.x, 1 + 1.5 * std::cos(angle), 1e-12);
    EXPECT_NEAR(pose.y, 2 + 1.5 * std::sin(angle), 1e-12);
    EXPECT_NEAR(std::remainder(pose.heading + 0.5 - (angle + kPi), 2 * kPi), 0, 1e-12);
  }
  std::get<ArcPath>(scene.path).look_outwards = true;
  EXPECT_NEAR(run(scene).truth[0].pose.heading, -0.5, 1e-12);
}

TEST_F(Paths, WaypointsTurnOnTheSpotAndDriveStraight) {
  scene.rate = 10;
  // 1 m at 0.5 m/s: 2 s. A right angle at pi/4 rad/s: 2 s. 0.5 m: 1 s. Together 5 s, frames 0..50.
  scene.path = WaypointPath{{{0, 0}, {1, 0}, {1, 0.5}}, 0.5, kPi / 4};
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.truth.size(), 51U);
  const auto pose_at = [&](std::size_t frame) { return simulated.truth[frame].pose; };
  EXPECT_NEAR(pose_at(10).x, 0.5, 1e-12);
  EXPECT_NEAR(pose_at(10).heading, 0, 1e-12);
  EXPECT_NEAR(pose_at(30).x, 1, 1e-12);
  EXPECT_NEAR(pose_at(30).heading, kPi / 4, 1e-12);
  EXPECT_NEAR(pose_at(45).y, 0.25, 1e-12);
  EXPECT_NEAR(pose_at(50).y, 0.5, 1e-12);
}

TEST_F(Paths, WaypointsTurnTheShortWay) {
  scene.rate = 10;
  scene.path = WaypointPath{{{0, 0}, {-1, 0.1}, {-2, -0.1}}, 1, 1};  // headings +3.04 and -2.94: 0.30 apart
  const Simulated simulated = run(scene);
  EXPECT_LT(simulated.truth.size(), 26U);
  for (std::size_t i = 1; i < simulated.log.odometry.size(); ++i) {
    EXPECT_LT(
        std::abs(simulated.log.odometry[i].heading.to_double() - simulated.log.odometry[i - 1].heading.to_double()),
        0.03);
  }
}

TEST_F(Paths, PosesAreInterpolatedTheShortWay) {
  scene.rate = 4;
  scene.path = PosesPath{{{0, 0, 0, 3.0}, {1, 1, 2, -3.0}}};
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.truth.size(), 5U);
  EXPECT_NEAR(simulated.truth[2].pose.x, 0.5, 1e-12);
  EXPECT_NEAR(simulated.truth[2].pose.y, 1, 1e-12);
  EXPECT_NEAR(simulated.truth[2].pose.heading, kPi, 1e-12);  // half way between 3 and 2 pi - 3
}

TEST_F(Paths, OneViewIsEnough) {
  scene.path = ArcPath{{0, 0}, 1, 0.5, 3, 1, false};
  EXPECT_EQ(run(scene).log.frames.size(), 1U);
}

TEST_F(Paths, ThroughAnObjectIsNoticed) {
  scene.rate = 10;
  scene.objects = {box_object(1, 0.45, -0.1, 0.55, 0.1, 0.2)};
  scene.path = WaypointPath{{{0, 0}, {1, 0}}, 1, 1};
  EXPECT_EQ(run(scene).summary.frames_inside, 1U);  // at 0.5 m
}

// A scene of a kilobyte that would take 10 GB.
TEST(Errors, AnImageIsNoLargerThanAPhotograph) {
  Scene scene = empty_scene();
  scene.path = standing(0, 0, 0, 1);
  scene.camera.width = 32'767;
  scene.camera.height = 32'767;
  const auto refused = simulate(scene, [](std::string_view) { FAIL() << "a line was written"; });
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().find("32767 x 32767"), std::string::npos) << refused.error();
  EXPECT_NE(refused.error().find("64 megapixels"), std::string::npos) << refused.error();
}

TEST(Errors, NoPathAndOutOfRangeAreSentences) {
  Scene scene = empty_scene();
  const auto ignore = [](std::string_view) {};
  const auto none = simulate(scene, ignore);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().find("no path"), std::string::npos);
  scene.path = standing(999, 0, 0, 100);
  scene.noise.pose_xy = 10;
  const auto outside = simulate(scene, ignore);
  ASSERT_FALSE(outside.ok());
  EXPECT_NE(outside.error().find("range"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
