// A camera that differs from its calibration is reported in every mode, in `status`, and as a record that is repeated.
// The alerts are more careful meanwhile. A camera that is right is never reported.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/loop/desk.hpp"
#include "tests/firmware/recon/post_world.hpp"

namespace fencepost::test {
namespace {

using DoubtfulRobot = Desk<config::Small>;

const std::vector<RoundPost> kBlocks = {{1, 1.2, 0.18, 0.04}, {2, 1.15, 0.0, 0.04}, {3, 1.2, -0.18, 0.04}};
constexpr double kFourDegrees = 4 * 3.14159265 / 180;

// 20 frames a second on the way at `speed` and `turn`; after `drives` seconds the robot stands.
Script drive(const TrueCamera& camera, double seconds, double speed, double turn, double drives) {
  Script script;
  double x = 0;
  double y = 0;
  double heading = 0;
  for (int i = 0; i < static_cast<int>(seconds * 20); ++i) {
    const base::Time t = base::Time::nearest(0.05 * i);
    script.odometry.push_back({t, sensor::OdometrySample{t, base::Metres::nearest(x), base::Metres::nearest(y),
                                                         base::Radians::nearest(heading)}});
    script.camera.push_back({t, view_of_posts(kBlocks, camera, x, y, heading, t.raw, static_cast<std::uint32_t>(i))});
    if (0.05 * i >= drives) continue;
    heading += 0.05 * turn;
    x += 0.05 * speed * std::cos(heading);
    y += 0.05 * speed * std::sin(heading);
  }
  return script;
}

struct Played {
  std::unique_ptr<DoubtfulRobot> robot;
  std::string said;
};
Played play(const TrueCamera& camera, console::Mode mode, double seconds, double speed, double turn = 0,
            double drives = 1000) {
  Played played{std::make_unique<DoubtfulRobot>(mode, drive(camera, seconds, speed, turn, drives)), ""};
  played.robot->pipeline().set_camera(level_pixy2(0));
  played.robot->turn(static_cast<int>(1000 * seconds) + 500);
  played.said = played.robot->link.take_said();
  return played;
}

TEST(CameraDoubt, OfItsPitchIsSaidInEachMode) {
  const TrueCamera down{.pitch = kFourDegrees};
  const Played text = play(down, console::Mode::kText, 6, 0.152);
  EXPECT_NE(text.said.find("CAMERA  check the camera's pitch and height: things are "), std::string::npos) << text.said;
  EXPECT_NE(text.said.find(" times nearer than it tells\r\n"), std::string::npos) << text.said;
  const Played log = play(down, console::Mode::kLog, 6, 0.152);
  EXPECT_NE(log.said.find("$FPCAL,"), std::string::npos) << log.said;
  EXPECT_NE(log.said.find(",rows,"), std::string::npos);
  const Played plot = play(down, console::Mode::kPlot, 6, 0.152);
  EXPECT_NE(plot.said.find(",doubt:1\r\n"), std::string::npos) << plot.said;
}

TEST(CameraDoubt, TheOtherWayRoundThingsAreFartherThanItTells) {
  const Played up = play({.pitch = -kFourDegrees}, console::Mode::kText, 6, 0.152);
  EXPECT_NE(up.said.find(" times farther than it tells\r\n"), std::string::npos) << up.said;
  EXPECT_EQ(up.robot->memory().camera_doubt.caution(), 1);
}

TEST(CameraDoubt, IsALineOfStatusWhileItLasts) {
  Played down = play({.pitch = kFourDegrees}, console::Mode::kQuiet, 6, 0.152);
  const std::string status = down.robot->type_line("status");
  EXPECT_NE(status.find("\r\ncheck the camera's pitch and height"), std::string::npos) << status;
  down.robot->type_line("reset");
  EXPECT_EQ(down.robot->type_line("status").find("check"), std::string::npos);
}

TEST(CameraDoubt, IsRepeatedWithTheCalibrationForThoseWhoBeginToRecordLate) {
  const Played late = play({.pitch = kFourDegrees}, console::Mode::kQuiet, 6, 0.152);
  EXPECT_NE(late.robot->type_line("mode log").find("$FPCAL,"), std::string::npos);
  const Played log = play({.pitch = kFourDegrees}, console::Mode::kLog, 25, 0.152, 0, 6);
  std::size_t records = 0;
  for (std::size_t at = log.said.find("$FPCAL"); at != std::string::npos; at = log.said.find("$FPCAL", at + 1)) {
    ++records;
  }
  EXPECT_GE(records, 2U) << log.said;
}

TEST(CameraDoubt, WidensTheDistancesOfAlertsMeanwhile) {
  const Played down = play({.pitch = kFourDegrees}, console::Mode::kQuiet, 6, 0.152);
  EXPECT_GT(down.robot->memory().camera_doubt.caution(), 1.2F);
  EXPECT_LE(down.robot->memory().camera_doubt.caution(), 2.0F);
}

TEST(CameraDoubt, OfItsLensIsSaidAfterTurning) {
  const Played wide = play({.focal = 273.6 / 1.3}, console::Mode::kText, 20, 0, 0.8);
  EXPECT_NE(wide.said.find("CAMERA  check the focal length, or the wheels' track: the lens seems configured 1."),
            std::string::npos)
      << wide.said;
  const Played log = play({.focal = 273.6 * 1.3}, console::Mode::kLog, 20, 0, 0.8);
  EXPECT_NE(log.said.find(",lens,0."), std::string::npos);
}

TEST(CameraDoubt, IsForgottenWithTheCalibration) {
  const Played down = play({.pitch = kFourDegrees}, console::Mode::kText, 6, 0.152);
  ASSERT_TRUE(down.robot->memory().camera_doubt.any());
  sensor::CameraIntrinsics told = level_pixy2(0);
  told.mount.pitch = base::Radians::nearest(kFourDegrees);
  down.robot->pipeline().set_camera(told);
  down.robot->turn(5);
  EXPECT_EQ(down.robot->link.take_said(), "CAMERA  nothing speaks against its calibration any more\r\n");
}

// The border cuts a wall where its foot leaves the image. That row stays the same while the robot drives.
TEST(CameraDoubt, NeverOfWallsThatTheBorderCuts) {
  constexpr double kHalfWidth = 0.4;  // m
  constexpr double kLength = 16;      // m
  Script script;
  for (int i = 0; i < 20 * 40; ++i) {
    const double x = 0.01 * i;
    const base::Time t = base::Time::nearest(0.05 * i);
    sensor::BlobFrame frame{t, static_cast<std::uint32_t>(i), {}};
    const double end = 273.6 * kHalfWidth / (kLength - x);  // px beside the middle of the image
    for (const bool left : {true, false}) {
      sensor::Blob wall;
      wall.signature = left ? 1 : 2;
      wall.x1 = static_cast<std::int16_t>(left ? 0 : std::lround(157.5 + end));
      wall.x2 = static_cast<std::int16_t>(left ? std::lround(157.5 - end) : 315);
      wall.y1 = 60;
      wall.y2 = static_cast<std::int16_t>(103.5 + 0.12 / kHalfWidth * 157.5);
      static_cast<void>(frame.blobs.push_back(wall));
    }
    script.odometry.push_back({t, desk_odometry(0.05 * i, x)});
    script.camera.push_back({t, frame});
  }
  DoubtfulRobot robot(console::Mode::kLog, std::move(script));
  robot.pipeline().set_camera(level_pixy2(0));
  robot.turn(40'500);
  EXPECT_EQ(robot.link.take_said().find("$FPCAL"), std::string::npos);
  EXPECT_GT(robot.memory().map.frames(), 700U) << "nothing was looked at";
}

TEST(CameraDoubt, NeverOfACameraThatIsAsTold) {
  for (const double turn : {0.0, 0.8, -0.5}) {
    const Played right = play({}, console::Mode::kLog, 20, turn == 0 ? 0.05 : 0.1, turn);
    EXPECT_EQ(right.said.find("$FPCAL"), std::string::npos) << turn;
    EXPECT_GT(right.robot->memory().map.frames(), 300U) << "nothing was looked at";
  }
}

}  // namespace
}  // namespace fencepost::test
