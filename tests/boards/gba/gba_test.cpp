// The Game Boy Advance image in its emulator.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/boards/bench.hpp"
#include "tests/boards/configured.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/every_board.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/gba/board.hpp"
#include "tests/boards/gba/counter.hpp"

namespace fencepost::test {
namespace {

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

TEST(Gba, SaysWhatFeedsIt) {
  Bench bench(gba());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("version", "stream format 1; fed by its link, never connected to an XBC camera\r\n"))
      << bench.said();
}

TEST(Gba, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(gba()); }

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

// The memory of a cartridge, beside its image.
TEST(Gba, StartsWithTheMemoryThatWasConfigured) {
  host::ConfigureRequest request;
  request.settings = {{"alert.stop", "0.31"}};
  std::ifstream file(configured_image("gba", ".gba", request) + ".sav", std::ios::binary);
  std::vector<std::uint8_t> save{std::istreambuf_iterator<char>(file), {}};
  ASSERT_EQ(save.size(), 32U * 1024);
  Bench bench(gba(nullptr, &save));
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("get alert.stop", "alert.stop = 0.31 m")) << bench.said();
  EXPECT_TRUE(bench.obey("set camera pixy2", "camera takes console\r\n")) << bench.said();
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
SceneStream slow_frames() {
  SceneStream stream = stream_of(eight_boxes(8));
  std::size_t frame = 0;
  std::erase_if(stream.inputs, [&](const SceneStream::Input& input) {
    return std::holds_alternative<sensor::BlobFrame>(input) && frame++ % 12 != 0;
  });
  return stream;
}

void count_eight_objects(PoseCorrected corrected) {
  const SceneStream stream = slow_frames();
  Handheld* machine = nullptr;
  Bench bench(gba(&machine));
  ASSERT_NO_FATAL_FAILURE(expect_ready_to_count(bench, stream, corrected));
  bench.run(0.5);  // not counted: the configuration
  const Stages screen = {
      {"screen", "MapView<fencepost::loop::Pipeline<fencepost::config::Small>, fencepost::mcu::gba::Screen>::turn("}};
  InstructionCounter counter(*machine, image_of("gba") + ".elf", stages_of_a_loop(screen));
  expect_full_table(bench, stream, 8);
  expect_counts_as_committed(counter.counts(), "gba", corrected, 30);
}

EveryBoardFacts facts() {
  EveryBoardFacts facts;
  facts.board = [] { return gba(); };
  facts.name = "gba";
  facts.profile = "small";
  facts.reset = "unknown";
  facts.rate = 10;  // with three objects and 50 odometry lines a second the part keeps up with eleven
  facts.corrected_rate = 7;
  facts.count = count_eight_objects;
  return facts;
}
INSTANTIATE_TEST_SUITE_P(Gba, EveryBoard, ::testing::Values(facts()), profile_of);

}  // namespace
}  // namespace fencepost::test
