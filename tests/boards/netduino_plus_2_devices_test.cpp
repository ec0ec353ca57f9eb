// The Netduino Plus 2 with other devices: a CMUcam4 and an iRobot Create 2 on their lines, and those of the two-wire
// bus. The emulator has no such bus. Nor has it the timers' inputs: a wheel never turns in here, see
// tests/firmware/image.
#include <gtest/gtest.h>

#include <numbers>

#include "drivers/cmucam/dialect.hpp"
#include "firmware/config/devices.hpp"
#include "host/emulate/models/camera_adapters.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "host/emulate/models/wheel_adapters.hpp"
#include "tests/boards/bench.hpp"
#include "tests/boards/configured.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/netduino_plus_2.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

// Open Interface specification of the Create 2: wheels of 72 mm, 508.8 counts a revolution.
constexpr emulate::WheelShape kCreate2 = {0.072 * std::numbers::pi / 508.8, 0.235};

// The Create on UART4 is the odometry; the camera's line is slower, and its two colours share its frames.
BoardUnderTest netduino_on_create() {
  BoardUnderTest board = netduino_plus_2({}, {"camera cmucam4", "odometry create2"});
  board.base = 3;
  board.camera_pace = 1'920;
  board.frames_share = 0.3;
  board.camera_device = [] {
    return emulate::make_cmucam_model(emulate::CmuCamModel::kFour, [](std::uint8_t) {
      return sensor::Rgb{0xd0, 0x20, 0x20};
    });
  };
  board.base_device = [] { return emulate::make_create_model(emulate::CreateModel::kTwo, kCreate2); };
  return board;
}

TEST(NetduinoDevices, ReplaysABoxSeenByACmucamOnACreate) {
  sensor::CameraMount mount;
  mount.x = base::Metres::nearest(0.05);
  mount.z = base::Metres::nearest(0.12);
  mount.pitch = base::Radians{0};
  expect_scene_replays(netduino_on_create(), "small",
                       box_beside_the_way(cmucam::nominal_intrinsics(cmucam::kCmuCam4, mount)));
}

/// A camera on the serial line, and what plays it.
struct LineCamera {
  const char* name;
  double pace;   ///< bytes a second
  double share;  ///< of the scene's frames; two colours alternate in a CMUcam's 17 a second
  std::unique_ptr<emulate::DeviceModel> (*make)();  ///< nothing: a Pixy2
};
std::ostream& operator<<(std::ostream& out, const LineCamera& camera) { return out << camera.name; }

template <emulate::CmuCamModel kModel>
std::unique_ptr<emulate::DeviceModel> cmucam_of_red() {
  return emulate::make_cmucam_model(kModel, [](std::uint8_t) { return sensor::Rgb{0xd0, 0x20, 0x20}; });
}

class NetduinoCamera : public ::testing::TestWithParam<LineCamera> {};

// Each with its own lens, to the last bit.
TEST_P(NetduinoCamera, ReplaysABoxThatItSees) {
  sensor::CameraIntrinsics camera = config::delivered_calibration(config::camera_named(GetParam().name));
  camera.mount.x = base::Metres::nearest(0.05);
  camera.mount.z = base::Metres::nearest(0.12);
  camera.mount.pitch = base::Radians{0};
  BoardUnderTest board = netduino_plus_2({}, {std::string("camera ") + GetParam().name});
  board.camera_pace = GetParam().pace;
  if (GetParam().make != nullptr) board.camera_device = GetParam().make;
  board.frames_share = GetParam().share;
  expect_scene_replays(board, "small", box_beside_the_way(camera));
}
INSTANTIATE_TEST_SUITE_P(
    Cameras, NetduinoCamera,
    ::testing::Values(LineCamera{"pixy2", 0, 0.9, nullptr}, LineCamera{"pixy2.1", 0, 0.9, nullptr},
                      LineCamera{"cmucam1", 11'520, 0.15, cmucam_of_red<emulate::CmuCamModel::kOne>},
                      LineCamera{"cmucam2", 11'520, 0.15, cmucam_of_red<emulate::CmuCamModel::kTwo>},
                      LineCamera{"cmucam3", 11'520, 0.15, cmucam_of_red<emulate::CmuCamModel::kThree>},
                      LineCamera{"huskylens", 960, 0.3,
                                 []() -> std::unique_ptr<emulate::DeviceModel> {
                                   return std::make_unique<emulate::HuskyLens>();
                                 }},
                      LineCamera{"nxtcam", 11'520, 0.5, emulate::make_nxtcam_model},
                      LineCamera{"xbc", 3'840, 0.5, emulate::make_xbc_model}));

TEST(NetduinoDevices, TellsOfACreateThatIsUnpluggedAndBack) {
  Bench bench(netduino_on_create());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.await("odometry works\r\n")) << bench.said();
  ASSERT_TRUE(bench.obey("mode log", "$FPLNK,")) << bench.said();
  bench.clear();
  bench.unplug_base(true);
  ASSERT_TRUE(bench.await(",odometry,silent,no answer*")) << bench.said();
  bench.unplug_base(false);
  ASSERT_TRUE(bench.await(",odometry,ok,*")) << bench.said();
  EXPECT_EQ(bench.said().find("READY"), std::string::npos) << "it was reset";
}

// Its bytes as fast as the emulator takes them; good frames of the Create come afterwards.
TEST(NetduinoDevices, SurvivesGarbageFromItsWheelBase) {
  Bench bench(netduino_on_create());
  ASSERT_TRUE(bench.await("odometry works\r\n")) << bench.said();
  bench.unplug_base(true);
  expect_takes_garbage(bench, {&bench.base_line()}, kFifteenSecondsOfBytes / 3);
  EXPECT_FALSE(bench.obey("status", "odometry link ok")) << bench.said();
  bench.unplug_base(false);
  bench.clear();
  ASSERT_TRUE(bench.obey("mode log", ",odometry,ok,*")) << bench.said();
  EXPECT_EQ(bench.said().find("READY"), std::string::npos) << "it was reset";
}

TEST(NetduinoDevices, StartsAsItsImageWasConfigured) {
  host::ConfigureRequest request;
  request.settings = {{"camera", "xbc"}, {"odometry", "create1"}, {"alert.stop", "0.31"}};
  Bench bench(netduino_plus_2({}, {}, configured_image("netduino_plus_2", ".bin", request) + ".bin"));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("status",
                         "camera xbc at 38400 baud (D1 sends, D0 receives), lens 45 deg; odometry create1 at "
                         "57600 baud (D8 sends, D7 receives)\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.31 m")) << bench.said();
}

class NetduinoTwoWire : public ::testing::TestWithParam<std::vector<std::string>> {};

// Encoders report by their count, which stays zero.
TEST_P(NetduinoTwoWire, GoesOnWithACameraBusThatHangs) {
  expect_survives_hung_camera_bus(netduino_plus_2({}, GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Cameras, NetduinoTwoWire,
                         ::testing::Values(std::vector<std::string>{"camera pixy2_i2c", "odometry encoders"},
                                           std::vector<std::string>{"camera nxtcam_i2c", "odometry create1"},
                                           std::vector<std::string>{"camera huskylens_i2c"}));

}  // namespace
}  // namespace fencepost::test
