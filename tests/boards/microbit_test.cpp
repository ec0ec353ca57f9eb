// The micro:bit image in its emulator.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/boards/bench.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/microbit.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

// The emulator answers 1 to all questions about power and clock: the first flag of RESETREAS is the pin's.
TEST(Microbit, SaysWhoItIsAndPassesItsSelfTest) {
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(
      bench.said().starts_with("fencepost 0.1.0 for microbit, profile micro\r\nreset: reset pin\r\npanic: none\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("version", "fencepost 0.1.0 for microbit")) << bench.said();
}

// A debugger sends the program to where nothing is; the core's hard fault ends in a reset.
TEST(Microbit, TellsOnceWhereTheLastRunDied) {
  Bench bench(microbit_with_debugger());
  const auto tell = [&bench](const std::string& packet) {
    unsigned sum = 0;
    for (const char c : packet) sum += static_cast<unsigned char>(c);
    std::array<char, 4> check{};
    std::snprintf(check.data(), check.size(), "#%02x", sum & 0xFFU);
    bench.line(2).send("+$" + packet + check.data());
    bench.run(0.3);
  };
  tell("?");
  tell("qXfer:features:read:target.xml:0,ffb");
  tell("c");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  bench.clear();
  bench.line(2).send("\x03");
  bench.run(0.3);
  tell("Pf=01000030");
  tell("c");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.line(2).take();
  EXPECT_NE(bench.said().find("reset: panic\r\npanic: exception 3 at 30000000, called from 0000"), std::string::npos)
      << bench.said();
  EXPECT_TRUE(bench.obey("version", "for microbit"));
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

TEST(Microbit, ReplaysAnApproach) { expect_scene_replays(microbit(), "micro", recorded_scene("approach_stop")); }
// Six objects for a table of four: the last two replace others, and are seen from few places before the end.
TEST(Microbit, ReplaysACorridor) { expect_scene_replays(microbit(), "micro", recorded_scene("corridor"), 0.2); }
TEST(Microbit, ReplaysAMinute) { expect_scene_replays(microbit(), "micro", minute_scene()); }
TEST(Microbit, ReplaysACorrectedPose) {
  expect_scene_replays(microbit(), "micro", minute_scene(20), 0.08, PoseCorrected::kYes);
}

// toolchain/long boards
TEST(Microbit, DISABLED_ReplaysTenMinutes) { expect_scene_replays(microbit(), "micro", minute_scene(600)); }

TEST(Microbit, SurvivesFramesThatStop) { expect_survives_camera_loss(microbit()); }
TEST(Microbit, SurvivesGarbageOnItsLine) { expect_survives_garbage(microbit()); }
TEST(Microbit, SurvivesOdometryThatStops) { expect_survives_odometry_loss(microbit()); }
TEST(Microbit, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(microbit()); }
TEST(Microbit, SurvivesLinesThatAreCut) { expect_survives_cut_lines(microbit()); }

// Pin 13, the row of the pixel at the upper left, in the pins' output register: on and off as long as the loop turns.
TEST(Microbit, BeatsItsHeart) {
  Bench bench(microbit());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  int on = 0;
  int off = 0;
  for (int i = 0; i < 40 && (on == 0 || off == 0); ++i) {
    static_cast<void>(bench.line(1).take());
    bench.line(1).send("xp /1xw 0x50000504\n");
    bench.run(0.1);
    const std::string answer = bench.line(1).take();
    const std::size_t at = answer.find(": 0x");
    if (at == std::string::npos) continue;
    const unsigned long pins = std::stoul(answer.substr(at + 4, 8), nullptr, 16);
    ++((pins >> 13 & 1) != 0 ? on : off);
  }
  EXPECT_GT(on, 0);
  EXPECT_GT(off, 0);
}

// The image of the real board. The emulator's two-wire bus takes every transfer and ends none: the master has to give
// up each of them, and the loop must not notice.
TEST(Microbit, GoesOnWithACameraBusThatHangs) {
  Bench bench(microbit("microbit"));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  bench.run(2.0);
  EXPECT_TRUE(bench.obey("status", "camera link silent")) << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_EQ(bench.said().find("READY"), std::string::npos) << "it was reset";
}

// A frame of four objects, all that it sets in motion: 60 frames a second of 16 MHz, at 1.4 cycles an instruction, are
// 190,000. The committed numbers say how far off that is.
void count_four_objects(PoseCorrected corrected) {
  const std::string image = "microbit-console";
  const std::string out = ::testing::TempDir() + "fencepost-microbit-counts";
  const auto arguments = counting_arguments(image_of(image) + ".elf", stages_of_a_loop(), out);
  const SceneStream stream = stream_of(four_boxes(8));
  Bench bench(microbit(image, arguments));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.correct_pose(corrected == PoseCorrected::kYes)) << bench.said();
  for (const std::string& line : stream.calibration) bench.console().send(line);
  bench.play(stream);
  EXPECT_TRUE(bench.obey("status", "objects 4 of 4")) << bench.said();
  bench.stop();
  expect_counts_as_committed(read_counts(out), image, corrected,
                             100);  // 160 were shown; a busy machine shows some too late
}
TEST(Microbit, CountsNoMoreInstructionsForFourObjectsThanCommitted) { count_four_objects(PoseCorrected::kNo); }
TEST(Microbit, CountsNoMoreInstructionsForACorrectedPoseThanCommitted) { count_four_objects(PoseCorrected::kYes); }

}  // namespace
}  // namespace fencepost::test
