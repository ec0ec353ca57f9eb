// The Raspberry Pi Pico's image in its emulator.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/boards/bench.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/boards/scenes.hpp"
#include "tests/firmware/app/desk.hpp"

namespace fencepost::test {
namespace {

TEST(Pico, SaysWhoItIsAndPassesItsSelfTest) {
  Bench bench(pico());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.said().starts_with("fencepost 0.1.0 for pico, profile small\r\nreset: power on\r\npanic: none\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("version", "fencepost 0.1.0 for pico")) << bench.said();
}

// firmware/FIRST_ALERT.md, steps 4 to 7: pushed by hand towards a red post, at 0.1 m/s.
TEST(Pico, SaysTheFirstAlertAsItsGuideDoes) {
  Bench bench(pico());
  ASSERT_TRUE(bench.await("odometry is silent: no $FPODO records come over the console; send them\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  bench.clear();
  bench.console().send(line_of(desk_camera()));
  bench.console().send(line_of(record::Signature{1, {0xd0, 0x20, 0x20}, "red"}));
  for (std::uint32_t i = 0; i < 160; ++i) {
    const double x = 0.005 * i;
    bench.give(desk_odometry(0.05 * i, x));
    bench.give(desk_frame(0.05 * i, i, x));
    bench.run(0.05);
  }
  std::size_t at = 0;
  for (const std::string_view sentence :
       {"odometry works\r\n", "NOTICE  red  0.", "WARN    red  0.4", "STOP    red  0.2"}) {
    at = bench.said().find(sentence, at);
    ASSERT_NE(at, std::string::npos) << sentence << " is not in\n" << bench.said();
  }
  EXPECT_TRUE(bench.obey("status", "camera link ok, pixy2 316x208; odometry link ok")) << bench.said();
}

TEST(Pico, ReplaysAnApproach) { expect_scene_replays(pico(), "small", recorded_scene("approach_stop")); }
TEST(Pico, ReplaysACorridor) { expect_scene_replays(pico(), "small", recorded_scene("corridor")); }
TEST(Pico, ReplaysAMinute) { expect_scene_replays(pico(), "small", minute_scene()); }
TEST(Pico, ReplaysACorrectedPose) {
  expect_scene_replays(pico(), "small", minute_scene(10), 0.08, PoseCorrected::kYes);
}

// toolchain/long boards
TEST(Pico, DISABLED_ReplaysTenMinutes) { expect_scene_replays(pico(), "small", minute_scene(600)); }

TEST(Pico, DISABLED_SurvivesAMinuteOfGarbage) { expect_survives_garbage(pico(), kMinuteOfBytes); }

TEST(Pico, SurvivesACameraThatIsUnplugged) { expect_survives_camera_loss(pico()); }
TEST(Pico, SurvivesGarbageOnAllLines) { expect_survives_garbage(pico()); }
TEST(Pico, SurvivesOdometryThatStops) { expect_survives_odometry_loss(pico()); }
TEST(Pico, SurvivesLinesThatAreCut) { expect_survives_cut_lines(pico()); }

// A frame of eight objects, all that it sets in motion, against what firmware/image/sizes.csv and stages.csv say.
void count_eight_objects(PoseCorrected corrected) {
  const std::string out = ::testing::TempDir() + "fencepost-pico-counts";
  const auto arguments =
      counting_arguments(image_of("pico") + ".elf",
                         stages_of_a_loop({{"camera", "::Camera<fencepost::mcu::rp2040::Uart>::receive("}}), out);
  static_cast<void>(std::remove(out.c_str()));  // of an earlier run
  const SceneStream stream = stream_of(eight_boxes(4));
  Bench bench(pico(nullptr, "fencepost", arguments.back()));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  ASSERT_TRUE(bench.correct_pose(corrected == PoseCorrected::kYes)) << bench.said();
  for (const std::string& line : stream.calibration) bench.console().send(line);
  bench.play(stream);
  EXPECT_TRUE(bench.obey("status", "objects 8 of 8")) << bench.said();
  bench.stop();
  expect_counts_as_committed(read_counts(out), "pico", corrected, 100);
}
TEST(Pico, CountsNoMoreInstructionsForEightObjectsThanCommitted) { count_eight_objects(PoseCorrected::kNo); }
TEST(Pico, CountsNoMoreInstructionsForACorrectedPoseThanCommitted) { count_eight_objects(PoseCorrected::kYes); }

}  // namespace
}  // namespace fencepost::test
