// The micro:bit v2's program on a machine with the same core: bits and instructions. No emulator has the board; that
// its image starts there, and what it does to the part, is tests/boards/nrf5.
#include <gtest/gtest.h>

#include <numbers>
#include <variant>

#include "drivers/pixy2/camera.hpp"
#include "host/emulate/models/wheel_adapters.hpp"
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

TEST(MicrobitV2, ReplaysAnApproachSeenOnItsSecondLine) {
  BoardUnderTest board = microbit_v2();
  board.configured = {"camera pixy2"};
  board.camera = kMicrobitV2Line;
  expect_scene_replays(board, "small", recorded_scene("approach_stop"));
}

// Open Interface specification of the Create 2: wheels of 72 mm, 508.8 counts a revolution.
TEST(MicrobitV2, ReplaysABoxBesideTheWayOfACreate) {
  BoardUnderTest board = microbit_v2();
  board.configured.emplace_back("odometry create2");
  board.base = kMicrobitV2Line;
  board.base_device = [] {
    return emulate::make_create_model(emulate::CreateModel::kTwo, {0.072 * std::numbers::pi / 508.8, 0.235});
  };
  sensor::CameraMount mount;
  mount.x = base::Metres::nearest(0.05);
  mount.z = base::Metres::nearest(0.12);
  mount.pitch = base::Radians{0};
  sensor::CameraIntrinsics camera = pixy2::kPixy2Profile;
  camera.mount = mount;
  expect_scene_replays(board, "small", box_beside_the_way(camera));
}

TEST(MicrobitV2, HasOneLineForACameraOrABase) {
  BoardUnderTest board = microbit_v2();
  board.configured = {"camera pixy2"};
  board.camera = kMicrobitV2Line;
  Bench bench(board);
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  EXPECT_TRUE(bench.obey("set odometry create2", "share the board's one serial line")) << bench.said();
  EXPECT_TRUE(bench.obey("set odometry encoders", "odometry = encoders; a new run")) << bench.said();
  EXPECT_TRUE(bench.obey("status",
                         "camera pixy2 at 115200 baud (ring 2 sends, ring 0 receives), lens 60 deg; odometry encoders "
                         "(13 and 14, 15 and 16)\r\n"))
      << bench.said();
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
