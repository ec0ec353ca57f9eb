// The STM32F405 image in its emulator.
#include <gtest/gtest.h>

#include "tests/boards/bench.hpp"
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

TEST(F405, ReplaysAnApproach) { expect_scene_replays(f405(), "small", recorded_scene("approach_stop")); }
TEST(F405, ReplaysACorridor) { expect_scene_replays(f405(), "small", recorded_scene("corridor")); }
TEST(F405, ReplaysAMinute) { expect_scene_replays(f405(), "small", minute_scene()); }

TEST(F405, SurvivesACameraThatIsUnplugged) { expect_survives_camera_loss(f405()); }
TEST(F405, SurvivesGarbageOnTheCamerasLine) { expect_survives_garbage_on_camera(f405()); }
TEST(F405, SurvivesGarbageOnTheConsole) { expect_survives_garbage_on_console(f405()); }
TEST(F405, SurvivesOdometryThatStops) { expect_survives_odometry_loss(f405()); }
TEST(F405, SurvivesAConsoleThatIsBlocked) { expect_survives_blocked_console(f405()); }
TEST(F405, SurvivesLinesThatAreCut) { expect_survives_cut_lines(f405()); }

}  // namespace
}  // namespace fencepost::test
