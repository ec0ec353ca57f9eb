// The micro:bit v2's program on a machine with the same core: bits and instructions. No emulator has the board; that
// its image starts there, and what it does to the part, is tests/boards/nrf5.
#include <gtest/gtest.h>

#include <variant>

#include "tests/boards/bench.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/microbit_v2/microbit_v2.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

TEST(MicrobitV2, PassesItsSelfTest) {
  Bench bench(microbit_v2());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.said().starts_with("fencepost 0.1.0 for microbit_v2, profile small\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
}

TEST(MicrobitV2, ReplaysAnApproach) { expect_scene_replays(microbit_v2(), "small", recorded_scene("approach_stop")); }
TEST(MicrobitV2, ReplaysACorrectedPose) {
  expect_scene_replays(microbit_v2(), "small", minute_scene(8, 20), 0.08, PoseCorrected::kYes);
}

// A frame of eight objects, all that it sets in motion, 25 frames a second, which the console's line can bring. At 50,
// a tenth of 64 MHz would be 90,000 instructions of 1.4 cycles each. 300 frames are shown.
void count_eight_objects(PoseCorrected corrected) {
  host::Scene scene = eight_boxes(12);
  scene.rate = 25;
  std::get<host::ArcPath>(scene.path).views = 300;
  const FullTable table{"microbit_v2", with_floor({}), scene, 8, 290, kMicrobitV2OnMps2};
  expect_full_table_as_committed(table, corrected, [](const auto& arguments) { return microbit_v2(arguments); });
}
TEST(MicrobitV2, CountsNoMoreInstructionsForAFullTableThanCommitted) { count_eight_objects(PoseCorrected::kNo); }
TEST(MicrobitV2, CountsNoMoreInstructionsForACorrectedPoseThanCommitted) { count_eight_objects(PoseCorrected::kYes); }

}  // namespace
}  // namespace fencepost::test
