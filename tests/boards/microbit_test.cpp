// The micro:bit image in its emulator.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/boards/bench.hpp"
#include "tests/boards/configured.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/debugger.hpp"
#include "tests/boards/every_board.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/microbit.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

// A frame of four objects, all that it sets in motion: 60 frames a second of 16 MHz, at 1.4 cycles an instruction, are
// 190,000. The committed numbers say how far off that is. 160 frames are shown.
// With correct.pose on, 23 of the 160 frames (20 a second) come too fast for this part.
void count_four_objects(PoseCorrected corrected) {
  const FullTable table{"microbit", {}, four_boxes(8), 4, 135};
  expect_full_table_as_committed(table, corrected, [](const auto& arguments) { return microbit(arguments); });
}

EveryBoardFacts facts() {
  EveryBoardFacts facts;
  facts.board = [] { return microbit(); };
  facts.name = "microbit";
  facts.profile = "micro";
  // The emulator answers 1 to all questions about power and clock: the first flag of RESETREAS is the pin's.
  facts.reset = "reset pin";
  // Six objects for a table of four: the last two replace others, and are seen from few places before the end.
  facts.corridor_placed = 0.2;
  facts.corrected_rate = 15;  // 470,000 instructions a frame, with its lines, and as much again in the worst
  facts.count = count_four_objects;
  return facts;
}
INSTANTIATE_TEST_SUITE_P(Microbit, EveryBoard, ::testing::Values(facts()), profile_of);

TEST(Microbit, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(microbit()); }
TEST(Microbit, TellsOnceWhereTheLastRunDied) { expect_tells_of_a_fault(microbit(), 0x00001235); }
// As it comes, and with each camera of its bus.
TEST(Microbit, GoesOnWithACameraBusThatHangs) {
  for (const auto& configured :
       std::vector<std::vector<std::string>>{{}, {"camera nxtcam_i2c"}, {"camera huskylens_i2c"}}) {
    expect_survives_hung_camera_bus(microbit({}, configured));
  }
}

// The emulator has the flash's controller, too: what is kept is kept by the part's own commands.
TEST(Microbit, KeepsSettingsOverAReset) {
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("set alert.stop 0.41", "alert.stop")) << bench.said();
  EXPECT_TRUE(bench.obey("set robot.width 0.33", "robot.width")) << bench.said();
  bench.run(0.2);
  EXPECT_EQ(bench.said().find("error"), std::string::npos) << bench.said();
  bench.clear();
  bench.line(1).send("system_reset\n");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "0.41")) << bench.said();
  EXPECT_TRUE(bench.obey("get robot.width", "0.33")) << bench.said();
  EXPECT_TRUE(bench.obey("get robot.margin", "0.05")) << bench.said();
}

// The same as its drive is given, but as a .bin: the emulator takes no .hex.
TEST(Microbit, StartsAsItsImageWasConfigured) {
  host::ConfigureRequest request;
  request.settings = {{"camera", "huskylens_i2c"}, {"lens", "50"}, {"alert.stop", "0.31"}};
  request.robot.signatures = {{1, {0xd0, 0x20, 0x20}, "red"}};
  Bench bench(microbit({}, {}, configured_image("microbit", ".bin", request) + ".bin"));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(
      bench.obey("status", "camera huskylens_i2c at 0x32 (20 data, 19 clock), lens 50 deg; odometry console\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.31 m")) << bench.said();
  EXPECT_TRUE(bench.obey("mode log", "$FPSIG,1,d02020,red*")) << bench.said();
}

TEST(Microbit, SaysWhichCamerasItHas) {
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(
      bench.obey("set camera pixy2",
                 "error: 'pixy2' is not possible: camera takes "
                 "console|pixy2_i2c|pixy2.1_i2c|huskylens_i2c|nxtcam_i2c|pixy1_i2c|huskylens2_i2c|grove_i2c\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("set odometry encoders", "odometry takes console\r\n")) << bench.said();
}

// The pins' output register, by the emulator's own console. Nothing: it has not answered in time.
std::optional<unsigned long> pins_of(Bench& bench, double wait) {
  static_cast<void>(bench.line(1).take());
  bench.line(1).send("xp /1xw 0x50000504\n");
  bench.run(wait);
  const std::string answer = bench.line(1).take();
  const std::size_t at = answer.find(": 0x");
  if (at == std::string::npos) return std::nullopt;
  return std::stoul(answer.substr(at + 4, 8), nullptr, 16);
}

// Pin 2, ring 1 of the edge connector: high only while the robot may drive.
bool released(Bench& bench) {
  for (int i = 0; i < 20; ++i) {
    const auto pins = pins_of(bench, 0.005);
    if (pins) return (*pins >> 2 & 1) != 0;
  }
  ADD_FAILURE() << "the emulator does not answer";
  return false;
}

TEST(Microbit, ItsStopPinFollowsTheAlert) {
  constexpr double kSpeed = 0.16;
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  double t = 0;
  double looked = 0;
  std::uint32_t number = 0;
  const auto drive = [&](double seconds, bool sees) {
    for (const double end = t + seconds - 1e-9; t < end; t += 0.02) {
      bench.console().send(line_of(desk_odometry(t, kSpeed * t)));
      if (sees && number++ % 2 == 0) bench.give(desk_frame(t, number, kSpeed * t));
      bench.run(0.02);
    }
  };
  EXPECT_FALSE(released(bench)) << "nothing has been seen";
  bench.console().send(line_of(level_pixy2()));
  ASSERT_TRUE(bench.obey("mode log", "mode is log"));
  drive(1.0, true);
  EXPECT_TRUE(released(bench)) << bench.said();
  bench.clear();
  for (; looked < 6 && bench.said().find(",stop,") == std::string::npos; looked += 0.02) drive(0.02, true);
  ASSERT_NE(bench.said().find(",stop,"), std::string::npos) << "it came to a stop";
  EXPECT_FALSE(released(bench));
}

TEST(Microbit, ItsStopPinFallsWithTheSender) {
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  bench.console().send(line_of(level_pixy2()));
  for (int i = 0; i < 50; ++i) {
    bench.console().send(line_of(desk_odometry(0.02 * i, 0)));
    if (i % 2 == 0) bench.give(desk_frame(0.02 * i, static_cast<std::uint32_t>(i), 0));
    bench.run(0.02);
  }
  EXPECT_TRUE(released(bench)) << bench.said();
  // 0.3 s after the last input was used; the last lines wait in the emulator's buffers for as long.
  bench.run(0.7);
  EXPECT_FALSE(released(bench)) << "all its inputs come from one sender";
}

// Pin 13, the row of the pixel at the upper left: on and off as long as the loop turns.
TEST(Microbit, BeatsItsHeart) {
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  int on = 0;
  int off = 0;
  for (int i = 0; i < 40 && (on == 0 || off == 0); ++i) {
    const auto pins = pins_of(bench, 0.1);
    if (pins) ++((*pins >> 13 & 1) != 0 ? on : off);
  }
  EXPECT_GT(on, 0);
  EXPECT_GT(off, 0);
}

}  // namespace
}  // namespace fencepost::test
