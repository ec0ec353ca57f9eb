// Cameras and wheels that are chosen at the console of a robot that has several.
#include <gtest/gtest.h>

#include <string>

#include "tests/firmware/loop/desk.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

using config::CameraId;
using config::OdometryId;

constexpr config::DeviceOffer kPico = {
    {(1U << config::kCameraIds) - 1, (1U << config::kOdometryIds) - 1, true, 8, true,
     config::Devices(CameraId::kPixy2, OdometryId::kConsole)},
    {"GP4 sends, GP5 receives", "GP4 sends, GP5 receives", "GP8 data, GP9 clock", "GP10 and 11, GP12 and 13"}};

struct DevicesConsole : ::testing::Test {
  explicit DevicesConsole(console::Mode mode = console::Mode::kText) : desk(mode) { desk.pipeline().offer(kPico); }
  std::string say(std::string_view line) { return desk.type_line(line); }
  [[nodiscard]] const sensor::CameraIntrinsics& calibration() { return desk.memory().calibration.intrinsics; }
  Desk<> desk;
};

TEST_F(DevicesConsole, AnotherCameraComesWithItsLensAndKeepsTheMount) {
  const sensor::CameraMount mount = calibration().mount;
  EXPECT_EQ(mount.z, base::Metres::nearest(0.12));
  const std::uint8_t before = desk.memory().choices;
  EXPECT_EQ(say("set camera pixy2.1"), "camera = pixy2.1; a new run: the map is empty\r\n");
  EXPECT_EQ(calibration().model.view(), "pixy2.1");
  EXPECT_EQ(calibration().fx.raw, 18'830);
  EXPECT_EQ(calibration().mount, mount);
  EXPECT_NE(desk.memory().choices, before);
  EXPECT_EQ(say("get camera").substr(0, 41), "camera = pixy2.1 (console|pixy2|pixy2.1|p");
}

TEST_F(DevicesConsole, ALensIsAnAngle) {
  EXPECT_EQ(say("set lens 80 deg"), "lens = 80 deg; a new run: the map is empty\r\n");
  EXPECT_NEAR(calibration().fx.raw, 18'830, 1);
  EXPECT_EQ(say("set lens 0"), "lens = 0 deg; a new run: the map is empty\r\n");
  EXPECT_EQ(calibration().fx.raw, 27'366);
  EXPECT_EQ(say("set lens wide"), "error: 'wide' is not possible: lens takes 0..150 deg\r\n");
}

TEST_F(DevicesConsole, WhatCannotWorkIsRefusedWithTheReason) {
  EXPECT_EQ(
      say("set odometry create2"),
      "error: 'create2' is not possible: camera and wheel base would share the board's one serial line beside the "
      "console; take a camera on the two-wire bus, such as pixy2_i2c\r\n");
  EXPECT_EQ(say("set camera nxtcam_i2c"),
            "error: 'nxtcam_i2c' is not possible: this part's two-wire bus does not speak to addresses 0 to 7, and an "
            "NXTCam has 1; connect its serial pins, camera nxtcam\r\n");
  EXPECT_EQ(desk.memory().devices, kPico.limits.initial);
  EXPECT_EQ(say("set camera pixy2_i2c"), "camera = pixy2_i2c; a new run: the map is empty\r\n");
  EXPECT_EQ(say("set odometry create2"), "odometry = create2; a new run: the map is empty\r\n");
}

TEST_F(DevicesConsole, MotorsGoByGoAlone) {
  const console::Motion& motion = desk.memory().console.motion;
  EXPECT_EQ(say("go"), "it may move while no alert forbids it; no motor is driven: `set bumper` is 0\r\n");
  EXPECT_EQ(say("set bumper 91"), "error: '91' is not possible: bumper takes 0..90 %\r\n");
  EXPECT_EQ(say("set bumper 40 %"), "bumper = 40 %; a new run: the map is empty\r\n");
  EXPECT_EQ(say("go"),
            "error: it may not move now: STOP or BLIND is in force, or a sensor is silent; `status` says more\r\n");
  EXPECT_FALSE(motion.ahead);
  desk.memory().console.motion.may = true;
  EXPECT_EQ(say("go"), "ahead, at 40 %, until an alert, or until you press Enter\r\n");
  EXPECT_TRUE(motion.ahead);
  static_cast<void>(desk.type(line_of(desk_odometry(1))));
  EXPECT_TRUE(motion.ahead) << "an input is nothing that was typed";
  for (const char* line : {"", "status", "nonsense", "\x80\x81", "stop"}) {
    static_cast<void>(say("go"));
    ASSERT_TRUE(motion.ahead) << line;
    static_cast<void>(desk.type(std::string(line) + "\r\n"));
    EXPECT_FALSE(motion.ahead) << line;
  }
}

TEST_F(DevicesConsole, TheButtonIsGoAndStop) {
  const console::Motion& motion = desk.memory().console.motion;
  static_cast<void>(say("set bumper 40"));
  desk.memory().console.motion.may = true;
  desk.press_button();
  desk.turn(2);
  EXPECT_EQ(desk.link.take_said(), "ahead, at 40 %, until an alert, or until you press Enter\r\n");
  EXPECT_TRUE(motion.ahead && motion.by_button && !motion.held);
  desk.memory().console.answer = {console::Reply::kVersion};
  desk.press_button();
  desk.turn(2);
  EXPECT_EQ(desk.link.take_said().rfind("fencepost", 0), 0U) << "the answer before is not lost";
  EXPECT_TRUE(!motion.ahead && !motion.by_button && motion.held);
}

TEST_F(DevicesConsole, StopHoldsUntilGo) {
  EXPECT_EQ(say("stop"), "held: nothing may move until `go`\r\n");
  EXPECT_TRUE(desk.memory().console.motion.held);
  static_cast<void>(say("reset"));
  EXPECT_TRUE(desk.memory().console.motion.held);
  static_cast<void>(say("go"));
  EXPECT_FALSE(desk.memory().console.motion.held);
  Desk<> elsewhere;
  static_cast<void>(elsewhere.type_line("stop"));
  EXPECT_TRUE(elsewhere.memory().console.motion.held);
  EXPECT_EQ(elsewhere.type_line("go"), "it may move while no alert forbids it\r\n");
  EXPECT_FALSE(elsewhere.memory().console.motion.held);
}

TEST_F(DevicesConsole, StatusHasItsLinesInOrder) {
  EXPECT_EQ(say("status"),
            "profile micro, mode text, alerts on, time not known yet\r\n"
            "camera link silent, pixy2 316x208; odometry link silent\r\n"
            "camera pixy2 at 115200 baud (GP4 sends, GP5 receives), lens 60 deg; odometry console\r\n"
            "frames used 0, refused: no_pose 0, odometry_gap 0, no_camera 0, queue 0\r\n"
            "blobs used 0, dropped 0; odometry 0; rejected 0; records dropped 0\r\n"
            "robot: no odometry yet\r\n"
            "objects 0 of 4, confirmed 0; digest cbf29ce484222325\r\n");
}

// 316 columns by a focal length of 223.50 px are 70.51 degrees, by 223.66 px 70.48.
TEST_F(DevicesConsole, ALensIsSaidInWholeDegrees) {
  for (const auto& [fx, degrees] : {std::pair(22'350, "lens 71 deg"), {22'366, "lens 70 deg"}}) {
    sensor::CameraIntrinsics own = calibration();
    own.fx = own.fy = {fx};
    static_cast<void>(desk.type(line_of(own)));
    EXPECT_NE(say("status").find(degrees), std::string::npos) << fx << say("status");
  }
}

TEST_F(DevicesConsole, WhatTheImageDoesNotContainIsAnsweredByWhatItDoes) {
  static constexpr config::DeviceOffer kFew = [] {
    config::DeviceOffer few = kPico;
    few.limits.cameras = 1U << static_cast<unsigned>(CameraId::kPixy2);
    few.limits.odometries = 1U << static_cast<unsigned>(OdometryId::kConsole);
    few.limits.motors = false;
    return few;
  }();
  desk.pipeline().offer(kFew);
  EXPECT_EQ(say("set camera cmucam1"), "error: 'cmucam1' is not possible: camera takes pixy2\r\n");
  EXPECT_EQ(say("set odometry encoders"), "error: 'encoders' is not possible: odometry takes console\r\n");
  EXPECT_EQ(say("go"), "it may move while no alert forbids it\r\n");
}

TEST_F(DevicesConsole, UnknownNamesAreAnsweredByThoseThatThereAre) {
  EXPECT_EQ(say("set odometry wheels"),
            "error: 'wheels' is not possible: odometry takes console|encoders|create1|create2\r\n");
  EXPECT_EQ(say("set camra pixy2"), "error: unknown setting 'camra', did you mean 'camera'? 'get' lists all\r\n");
}

TEST_F(DevicesConsole, StatusNamesCameraLensBaudAndPins) {
  EXPECT_NE(
      say("status").find("\r\ncamera pixy2 at 115200 baud (GP4 sends, GP5 receives), lens 60 deg; odometry console"
                         "\r\n"),
      std::string::npos);
  static_cast<void>(say("set camera huskylens_i2c"));
  static_cast<void>(say("set odometry encoders"));
  EXPECT_NE(say("status").find("\r\ncamera huskylens_i2c at 0x32 (GP8 data, GP9 clock), lens 60 deg; odometry encoders "
                               "(GP10 and 11, GP12 and 13)\r\n"),
            std::string::npos)
      << say("status");
  sensor::CameraIntrinsics own = calibration();
  own.fx = own.fy = {40'000};
  static_cast<void>(desk.type(line_of(own)));
  EXPECT_NE(say("status").find(", lens 44 deg by $FPCAM; "), std::string::npos) << say("status");
}

TEST_F(DevicesConsole, SettingsAndGetListThem) {
  const std::string help = "\r\n" + say("settings");
  for (const config::KeyInfo& entry : config::kDeviceInfo) {
    EXPECT_NE(help.find("\r\n  " + std::string(entry.name) + " "), std::string::npos) << entry.name;
    EXPECT_NE(say("get").find("  " + std::string(entry.name) + " "), std::string::npos) << entry.name;
  }
  EXPECT_EQ(Desk<>{}.type_line("settings").find("\r\n  camera "), std::string::npos) << "nothing to choose on a desk";
  EXPECT_EQ(Desk<>{}.type_line("set camera pixy2").substr(0, 31), "error: unknown setting 'camera'");
}

TEST_F(DevicesConsole, ACameraOfTheConsoleHasNoCalibrationUntilItComes) {
  static_cast<void>(say("set camera console"));
  EXPECT_FALSE(desk.memory().calibration.known);
  EXPECT_EQ(say("set lens 60").substr(0, 27), "error: '60' is not possible");
  static_cast<void>(desk.type(line_of(level_pixy2())));
  EXPECT_TRUE(desk.memory().calibration.known);
  static_cast<void>(say("set odometry encoders"));
  EXPECT_TRUE(desk.memory().calibration.known) << "only the wheels are others";
}

// Whoever reads the log later has to know through which lens its frames were seen.
TEST_F(DevicesConsole, TheLogSaysWhichCalibrationIsInForce) {
  static_cast<void>(say("mode log"));
  const std::string said = say("set camera pixy2.1");
  const std::size_t header = said.find("$FPHDR,");
  EXPECT_NE(header, std::string::npos) << said;
  EXPECT_NE(said.find("$FPCAM,pixy2.1,316,208,188.30,", header), std::string::npos) << said;
}

}  // namespace
}  // namespace fencepost::test
