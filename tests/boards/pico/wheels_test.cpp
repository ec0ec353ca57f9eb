// The Pico with its camera on the two-wire bus and encoders at the wheels.
#include <gtest/gtest.h>

#include "tests/boards/bench.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

BoardUnderTest with_wheels(BoardUnderTest board) {
  board.configured = {"camera pixy2_i2c", "odometry encoders"};
  return board;
}

struct PicoWheels : ::testing::Test {
  EmulatedPico* machine = nullptr;
  Bench bench{with_wheels(pico(&machine))};

  void SetUp() override { ASSERT_TRUE(bench.await("READY\r\n")) << bench.said(); }
  void emulator(const std::string& command, double seconds) {
    machine->command(command);
    bench.pump();  // the command takes its own time
    bench.run(seconds);
  }
};

TEST_F(PicoWheels, SeesThroughTheTwoWireBus) {
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  ASSERT_TRUE(bench.obey("mode log", "mode is log"));
  emulator("turn 4 4 300", 0.1);
  bench.clear();
  for (std::uint32_t i = 0; i < 20; ++i) {
    bench.give(desk_frame(0.05 * i, i, 0));
    bench.run(0.05);
  }
  EXPECT_NE(bench.said().find("$FPFRM,"), std::string::npos) << bench.said();
}

TEST_F(PicoWheels, TellsThatTheCameraIsGoneAndBack) {
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  emulator("camera gone", 1.5);
  EXPECT_TRUE(bench.obey("status", "camera link silent")) << bench.said();
  emulator("camera back", 0);
  ASSERT_TRUE(bench.await_camera()) << bench.said();
}

// As firmware/config/devices.hpp has it: 1440 counts are a turn of a wheel of 65 mm, 0.2042 m; the track is 130 mm.
TEST_F(PicoWheels, CountsItsWheels) {
  emulator("turn 1440 1440 300", 0.1);
  EXPECT_TRUE(bench.obey("status", "robot x 0.20 m, y 0.00 m, heading 0 deg")) << bench.said();
  emulator("turn -1440 -1440 300", 0.1);
  EXPECT_TRUE(bench.obey("status", "robot x 0.00 m, y 0.00 m, heading 0 deg")) << bench.said();
  emulator("turn -720 720 300", 0.1);  // 0.1021 m each: 90 deg
  EXPECT_TRUE(bench.obey("status", "robot x 0.00 m, y 0.00 m, heading 90 deg")) << bench.said();
}

// The Pico's program on the XRP's pins.
TEST(XrpWheels, CountsItsWheels) {
  EmulatedPico* machine = nullptr;
  Bench bench(with_wheels(pico(&machine, "fencepost-xrp")));
  ASSERT_TRUE(bench.await("panic: none\r\n")) << bench.said();
  EXPECT_NE(bench.said().find("fencepost 0.1.0 for xrp"), std::string::npos) << bench.said();
  machine->command("turn 1440 1440 300");
  bench.pump();
  bench.run(0.1);
  EXPECT_TRUE(bench.obey("status", "robot x 0.20 m, y 0.00 m, heading 0 deg")) << bench.said();
}

// As hal/boards/README.md says: 20,000 edges a second of each wheel, while camera and console are at work. To and fro,
// for a wheel as fast as that is taken for a fault.
TEST_F(PicoWheels, LosesNoCountAtTheHighestRate) {
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  bench.console().send("help\r");
  for (int i = 0; i < 100; ++i) {
    emulator("turn 101 101 50", 0);
    emulator("turn -100 -100 50", 0.001);
  }
  emulator("turn 1340 1340 300", 0.1);
  EXPECT_TRUE(bench.obey("status", "robot x 0.20 m, y 0.00 m, heading 0 deg")) << bench.said();
}

}  // namespace
}  // namespace fencepost::test
