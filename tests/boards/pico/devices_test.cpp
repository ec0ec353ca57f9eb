// The Pico's cameras and wheels, chosen at its console, and by `fencepost configure` before it starts.
#include <gtest/gtest.h>

#include "host/emulate/models/camera_adapters.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "tests/boards/bench.hpp"
#include "tests/boards/configured.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

struct PicoCamera {
  const char* name;
  const char* calibration;                          ///< as the log begins
  std::unique_ptr<emulate::DeviceModel> (*make)();  ///< nothing: a Pixy2
};
std::ostream& operator<<(std::ostream& out, const PicoCamera& camera) { return out << camera.name; }

template <emulate::CmuCamModel kModel>
std::unique_ptr<emulate::DeviceModel> cmucam_of_red() {
  return emulate::make_cmucam_model(kModel, [](std::uint8_t) { return sensor::Rgb{0xd0, 0x20, 0x20}; });
}
std::unique_ptr<emulate::DeviceModel> huskylens() { return std::make_unique<emulate::HuskyLens>(); }

// Inside the smallest image.
sensor::BlobFrame red_spot(std::uint32_t number) {
  sensor::BlobFrame frame{base::Time::nearest(0.05 * number), number, {}};
  static_cast<void>(frame.blobs.push_back({1, 20, 40, 39, 59, {295}, {495}, 400, sensor::Rgb{0xd0, 0x20, 0x20}}));
  return frame;
}

class PicoDevices : public ::testing::TestWithParam<PicoCamera> {};

TEST_P(PicoDevices, EachCameraIsSeenThroughItsOwnLens) {
  BoardUnderTest board = pico();
  board.configured = {std::string("camera ") + GetParam().name};
  if (GetParam().make != nullptr) board.camera_device = GetParam().make;
  Bench bench(board);
  ASSERT_TRUE(bench.await_camera(20)) << bench.said();
  bench.clear();
  ASSERT_TRUE(bench.obey("mode log", "mode is log")) << bench.said();
  ASSERT_TRUE(bench.await(GetParam().calibration)) << bench.said();
  for (std::uint32_t i = 0; i < 100 && bench.said().find(",1,1,") == std::string::npos; ++i) {
    bench.give(desk_odometry(0.05 * i));
    bench.give(red_spot(i));
    bench.run(0.05);
  }
  EXPECT_NE(bench.said().find(",1,1,"), std::string::npos)
      << "no frame with one blob: " << bench.said().substr(0, 3'000);
}
INSTANTIATE_TEST_SUITE_P(
    Cameras, PicoDevices,
    ::testing::Values(PicoCamera{"pixy2.1", "$FPCAM,pixy2.1,316,208,188.30,", nullptr},
                      PicoCamera{"pixy2.1_i2c", "$FPCAM,pixy2.1,316,208,188.30,", nullptr},
                      PicoCamera{"cmucam1", "$FPCAM,cmucam1,80,143,", cmucam_of_red<emulate::CmuCamModel::kOne>},
                      PicoCamera{"cmucam2", "$FPCAM,cmucam2,", cmucam_of_red<emulate::CmuCamModel::kTwo>},
                      PicoCamera{"cmucam3", "$FPCAM,cmucam3,", cmucam_of_red<emulate::CmuCamModel::kThree>},
                      PicoCamera{"cmucam4", "$FPCAM,cmucam4,160,120,", cmucam_of_red<emulate::CmuCamModel::kFour>},
                      PicoCamera{"huskylens", "$FPCAM,huskylens,320,240,", huskylens},
                      PicoCamera{"huskylens_i2c", "$FPCAM,huskylens,320,240,", huskylens},
                      PicoCamera{"nxtcam", "$FPCAM,nxtcam,176,144,", emulate::make_nxtcam_model},
                      PicoCamera{"xbc", "$FPCAM,xbc,356,", emulate::make_xbc_model}));

TEST(PicoDevice, IsChosenAtOnceAndKept) {
  EmulatedPico* machine = nullptr;
  Bench bench(pico(&machine));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  EXPECT_TRUE(bench.obey("set odometry create2", "share the board's one serial line")) << bench.said();
  EXPECT_TRUE(bench.obey("set camera nxtcam_i2c", "does not speak to addresses 0 to 7")) << bench.said();
  EXPECT_TRUE(bench.obey("set camera pixy2_i2c", "camera = pixy2_i2c; a new run")) << bench.said();
  ASSERT_TRUE(bench.await_camera()) << "on the other wires: " << bench.said();
  EXPECT_TRUE(bench.obey("set odometry encoders", "odometry = encoders; a new run")) << bench.said();
  EXPECT_TRUE(bench.obey("set camera pixy2", "camera = pixy2; a new run")) << bench.said();
  ASSERT_TRUE(bench.await_camera()) << "and back: " << bench.said();
  EXPECT_TRUE(bench.obey("set camera pixy2.1", "camera = pixy2.1; a new run")) << bench.said();
  bench.run(0.2);
  bench.clear();
  machine->command("power");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("status",
                         "camera pixy2.1 at 115200 baud (GP4 sends, GP5 receives), lens 80 deg; odometry "
                         "encoders (GP10 and 11, GP12 and 13)\r\n"))
      << bench.said();
}

// The same as the drive is given, on a desk without a compiler.
TEST(PicoDevice, StartsAsItsImageWasConfigured) {
  host::ConfigureRequest request;
  request.settings = {{"camera", "pixy2.1_i2c"}, {"odometry", "create2"}, {"drive", "100"}, {"alert.stop", "0.31"}};
  request.robot.signatures = {{1, {0xd0, 0x20, 0x20}, "red"}};
  request.robot.camera.mount = sensor::CameraMount{{500}, {0}, {1'200}, {0}, base::Radians{0}};
  static_cast<void>(configured_image("pico", ".uf2", request));

  Bench bench(pico(nullptr, "configured-for-a-test"));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("status",
                         "camera pixy2.1_i2c at 0x54 (GP8 data, GP9 clock), lens 80 deg; odometry create2 at "
                         "115200 baud (GP4 sends, GP5 receives)\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.31 m")) << bench.said();
  EXPECT_TRUE(bench.obey("get drive", "drive = 100 mm/s")) << bench.said();
  EXPECT_TRUE(bench.obey("mode log", "$FPSIG,1,d02020,red*")) << bench.said();
  EXPECT_NE(bench.said().find("$FPCAM,pixy2.1,316,208,188.30,188.30,157.50,103.50,0.0000,0.0500,0.0000,0.1200,0.0000,"
                              "0.0000,0.0330*"),
            std::string::npos)
      << bench.said();
}

}  // namespace
}  // namespace fencepost::test
