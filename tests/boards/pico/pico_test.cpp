// The Raspberry Pi Pico's image in its emulator.
#include <gtest/gtest.h>

#include "tests/boards/bench.hpp"
#include "tests/boards/faults.hpp"
#include "tests/boards/pico/pico.hpp"
#include "tests/boards/scenes.hpp"

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

TEST(Pico, ReplaysAnApproach) { expect_scene_replays(pico(), "small", recorded_scene("approach_stop")); }
TEST(Pico, ReplaysACorridor) { expect_scene_replays(pico(), "small", recorded_scene("corridor")); }
TEST(Pico, ReplaysAMinute) { expect_scene_replays(pico(), "small", minute_scene()); }

// toolchain/long boards
TEST(Pico, DISABLED_ReplaysTenMinutes) { expect_scene_replays(pico(), "small", minute_scene(600)); }

TEST(Pico, SurvivesACameraThatIsUnplugged) { expect_survives_camera_loss(pico()); }
TEST(Pico, SurvivesGarbageOnAllLines) { expect_survives_garbage(pico()); }
TEST(Pico, SurvivesOdometryThatStops) { expect_survives_odometry_loss(pico()); }
TEST(Pico, SurvivesLinesThatAreCut) { expect_survives_cut_lines(pico()); }

}  // namespace
}  // namespace fencepost::test
