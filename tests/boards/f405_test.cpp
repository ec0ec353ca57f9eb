// The STM32F405 image in its emulator.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/boards/bench.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/f405.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

TEST(F405, SaysWhoItIsAndPassesItsSelfTest) {
  Bench bench(f405());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.said().starts_with("fencepost 0.1.0 for f405, profile small\r\nreset: unknown\r\npanic: none\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("version", "fencepost 0.1.0 for f405")) << bench.said();
}

// A packet of GDB's remote protocol (its manual, appendix E), and time to answer.
void tell_debugger(Bench& bench, const std::string& packet) {
  unsigned sum = 0;
  for (const char c : packet) sum += static_cast<unsigned char>(c);
  std::array<char, 4> check{};
  std::snprintf(check.data(), check.size(), "#%02x", sum & 0xFFU);
  bench.line(3).send("+$" + packet + check.data());
  bench.run(0.3);
}

// The debugger sends the program to where there is no memory: a hard fault, a reset, and the next run tells, once.
TEST(F405, TellsOnceWhereTheLastRunDied) {
  Bench bench(f405_with_debugger());
  tell_debugger(bench, "?");
  tell_debugger(bench, "qXfer:features:read:target.xml:0,ffb");
  tell_debugger(bench, "c");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_NE(bench.said().find("panic: none"), std::string::npos) << bench.said();
  bench.clear();
  bench.line(3).send("\x03");
  bench.run(0.3);
  tell_debugger(bench, "Pf=01000030");
  tell_debugger(bench, "c");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.line(3).take();
  EXPECT_NE(bench.said().find("reset: panic\r\npanic: exception 3 at 30000000, called from 08"), std::string::npos)
      << bench.said();
  EXPECT_TRUE(bench.obey("version", "for f405"));
}

TEST(F405, ReplaysAnApproach) { expect_scene_replays(f405(), "small", recorded_scene("approach_stop")); }
TEST(F405, ReplaysACorridor) { expect_scene_replays(f405(), "small", recorded_scene("corridor")); }
TEST(F405, ReplaysAMinute) { expect_scene_replays(f405(), "small", minute_scene()); }
TEST(F405, ReplaysACorrectedPose) {
  expect_scene_replays(f405(), "small", minute_scene(20), 0.08, PoseCorrected::kYes);
}

// toolchain/long boards
TEST(F405, DISABLED_ReplaysTenMinutes) { expect_scene_replays(f405(), "small", minute_scene(600)); }

TEST(F405, DISABLED_SurvivesAMinuteOfGarbage) { expect_survives_garbage(f405(), kMinuteOfBytes); }

TEST(F405, SurvivesACameraThatIsUnplugged) { expect_survives_camera_loss(f405()); }
TEST(F405, SurvivesGarbageOnAllLines) { expect_survives_garbage(f405()); }
TEST(F405, SurvivesOdometryThatStops) { expect_survives_odometry_loss(f405()); }
TEST(F405, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(f405()); }
TEST(F405, SurvivesLinesThatAreCut) { expect_survives_cut_lines(f405()); }

// A frame of eight objects, all that it sets in motion. At 50 frames a second 336,000 cycles are a tenth of 168 MHz,
// that is 240,000 instructions at 1.4 cycles each. Most of it updates models and outlines of the objects whose turn it
// is.
void count_eight_objects(PoseCorrected corrected) {
  const std::string out = ::testing::TempDir() + "fencepost-f405-counts";
  const auto arguments =
      counting_arguments(image_of("f405") + ".elf",
                         stages_of_a_loop({{"camera", "::Camera<fencepost::mcu::stm32f4::Uart>::receive("}}), out);
  static_cast<void>(std::remove(out.c_str()));  // of an earlier run
  const double seconds = 12;
  const SceneStream stream = stream_of(eight_boxes(seconds));
  Bench bench(f405(arguments));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  ASSERT_TRUE(bench.correct_pose(corrected == PoseCorrected::kYes)) << bench.said();
  for (const std::string& line : stream.calibration) bench.console().send(line);
  bench.play(stream);
  EXPECT_TRUE(bench.obey("status", "objects 8 of 8")) << bench.said();
  bench.stop();
  expect_counts_as_committed(read_counts(out), "f405", corrected,
                             400);  // 600 were shown; a busy machine shows some too late
}
TEST(F405, CountsNoMoreInstructionsForEightObjectsThanCommitted) { count_eight_objects(PoseCorrected::kNo); }
TEST(F405, CountsNoMoreInstructionsForACorrectedPoseThanCommitted) { count_eight_objects(PoseCorrected::kYes); }

}  // namespace
}  // namespace fencepost::test
