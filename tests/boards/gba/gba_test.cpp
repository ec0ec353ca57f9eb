// The Game Boy Advance image in its emulator.
#include <gtest/gtest.h>

#include "tests/boards/bench.hpp"
#include "tests/boards/gba/board.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

TEST(Gba, SaysWhoItIsAndPassesItsSelfTest) {
  Bench bench(gba());
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.said().starts_with("fencepost 0.1.0 for gba, profile small")) << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("version", "fencepost 0.1.0 for gba")) << bench.said();
}

TEST(Gba, ReplaysAnApproach) { expect_scene_replays(gba(), "small", recorded_scene("approach_stop")); }
TEST(Gba, ReplaysACorridor) { expect_scene_replays(gba(), "small", recorded_scene("corridor")); }
TEST(Gba, ReplaysAMinute) { expect_scene_replays(gba(), "small", minute_scene()); }

}  // namespace
}  // namespace fencepost::test
