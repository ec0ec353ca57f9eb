// The Game Boy Advance image in its emulator.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/boards/bench.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/gba/board.hpp"
#include "tests/boards/gba/counter.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

// Frames a second of the minute: with three objects and 50 odometry lines a second the part keeps up with eleven.
constexpr double kRate = 10;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Gba, HasAHeaderThatAConsoleAccepts) {
  const std::string image = bytes_of(image_of("gba") + ".gba");
  ASSERT_GT(image.size(), 0xC0U);
  EXPECT_EQ(image.substr(0, 4), std::string("\x2E\x00\x00\xEA", 4));
  EXPECT_EQ(image.substr(4, 156), std::string(156, '\0')) << "the maker's picture is not ours to hand out";
  EXPECT_EQ(image.substr(0xA0, 12), std::string("FENCEPOST\0\0\0", 12));
  EXPECT_EQ(image[0xB2], '\x96');
  unsigned sum = 0x19;
  for (std::size_t i = 0xA0; i <= 0xBD; ++i) sum += static_cast<unsigned char>(image[i]);
  EXPECT_EQ(sum & 0xFFU, 0U);
}

TEST(Gba, SaysWhoItIsAndPassesItsSelfTest) {
  Bench bench(gba());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.said().starts_with("fencepost 0.1.0 for gba, profile small\r\nreset: unknown\r\npanic: none\r\n"))
      << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("version", "stream format 1; fed by its link, never connected to an XBC camera\r\n"))
      << bench.said();
}

TEST(Gba, ReplaysAnApproach) { expect_scene_replays(gba(), "small", recorded_scene("approach_stop")); }
TEST(Gba, ReplaysACorridor) { expect_scene_replays(gba(), "small", recorded_scene("corridor")); }
TEST(Gba, ReplaysAMinute) { expect_scene_replays(gba(), "small", minute_scene(60, kRate)); }
TEST(Gba, ReplaysACorrectedPose) {
  expect_scene_replays(gba(), "small", minute_scene(20, kRate), 0.08, PoseCorrected::kYes);
}

// toolchain/long boards
TEST(Gba, DISABLED_ReplaysTenMinutes) { expect_scene_replays(gba(), "small", minute_scene(600, kRate)); }

TEST(Gba, SurvivesACameraThatIsUnplugged) { expect_survives_camera_loss(gba()); }
TEST(Gba, SurvivesGarbageOnItsLine) { expect_survives_garbage(gba()); }
TEST(Gba, SurvivesOdometryThatStops) { expect_survives_odometry_loss(gba()); }
TEST(Gba, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(gba()); }
TEST(Gba, SurvivesLinesThatAreCut) { expect_survives_cut_lines(gba()); }

TEST(Gba, KeepsItsSettingsInTheCartridge) {
  std::vector<std::uint8_t> battery;
  {
    Bench bench(gba(nullptr, &battery));
    ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
    EXPECT_TRUE(bench.obey("set alert.stop 0.31", "alert.stop = 0.31")) << bench.said();
    bench.run(0.5);
  }
  EXPECT_EQ(battery.size(), 32U * 1024);
  {
    Bench bench(gba(nullptr, &battery));
    ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
    EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.31")) << bench.said();
  }
  std::fill(battery.begin(), battery.end(), std::uint8_t{0xFF});
  Bench bench(gba(nullptr, &battery));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_FALSE(bench.obey("get alert.stop", "alert.stop = 0.31"));
}

TEST(Gba, TalksThroughItsLinkPortAsThroughTheMailbox) {
  Handheld* machine = nullptr;
  Bench bench(gba(&machine, nullptr, Handheld::Console::kLinkPort));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  const SceneStream stream = stream_of(recorded_scene("approach_stop"));
  ASSERT_TRUE(bench.start_log(stream)) << bench.said();
  bench.play(stream);
  EXPECT_NE(bench.said().find("$FPALR,"), std::string::npos);
  EXPECT_TRUE(bench.obey("status", "rejected 0; records dropped 0")) << bench.said();
  EXPECT_EQ(machine->link_port().overruns(), 0U);  // at 57600 baud; four bytes is all that the port holds
}

// At 50 frames a second this part would be far behind; slower, a frame is the same work.
void count_eight_objects(PoseCorrected corrected) {
  host::Scene scene = eight_boxes(8);
  SceneStream stream = stream_of(scene);
  std::size_t frame = 0;
  std::erase_if(stream.inputs, [&](const SceneStream::Input& input) {
    return std::holds_alternative<sensor::BlobFrame>(input) && frame++ % 12 != 0;
  });
  Handheld* machine = nullptr;
  Bench bench(gba(&machine));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.correct_pose(corrected == PoseCorrected::kYes)) << bench.said();
  for (const std::string& line : stream.calibration) bench.console().send(line);
  bench.run(0.5);
  const Stages screen = {{"screen", "MapView<fencepost::config::Small, fencepost::mcu::gba::Screen>::turn("}};
  InstructionCounter counter(*machine, image_of("gba") + ".elf", stages_of_a_loop(screen));
  bench.play(stream);
  EXPECT_TRUE(bench.obey("status", "objects 8 of 8")) << bench.said();
  expect_counts_as_committed(counter.counts(), "gba", corrected, 30);
}
TEST(Gba, CountsNoMoreInstructionsForEightObjectsThanCommitted) { count_eight_objects(PoseCorrected::kNo); }
TEST(Gba, CountsNoMoreInstructionsForACorrectedPoseThanCommitted) { count_eight_objects(PoseCorrected::kYes); }

}  // namespace
}  // namespace fencepost::test
