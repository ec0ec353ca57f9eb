#include "tests/boards/every_board.hpp"

#include "tests/boards/faults.hpp"
#include "tests/boards/scenes.hpp"

namespace fencepost::test {
namespace {

TEST_P(EveryBoard, SaysWhoItIsAndPassesItsSelfTest) {
  Bench bench(board());
  const std::string name = "fencepost 0.1.0 for " + GetParam().name;
  const std::string first =
      name + ", profile " + GetParam().profile + "\r\nreset: " + GetParam().reset + "\r\npanic: none\r\n";
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.said().starts_with(first)) << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("version", name)) << bench.said();
}

TEST_P(EveryBoard, ReplaysAnApproach) {
  expect_scene_replays(board(), GetParam().profile, recorded_scene("approach_stop"));
}
TEST_P(EveryBoard, ReplaysACorridor) {
  expect_scene_replays(board(), GetParam().profile, recorded_scene("corridor"), GetParam().corridor_placed);
}
TEST_P(EveryBoard, ReplaysAMinute) {
  expect_scene_replays(board(), GetParam().profile, minute_scene(60, GetParam().rate));
}
TEST_P(EveryBoard, ReplaysACorrectedPose) {
  expect_scene_replays(board(), GetParam().profile,
                       minute_scene(GetParam().corrected_seconds, GetParam().corrected_rate), 0.08,
                       PoseCorrected::kYes);
}

// toolchain/long boards
TEST_P(EveryBoard, DISABLED_ReplaysTenMinutes) {
  expect_scene_replays(board(), GetParam().profile, minute_scene(600, GetParam().rate));
}
TEST_P(EveryBoard, DISABLED_SurvivesAMinuteOfGarbage) { expect_survives_garbage(board(), kMinuteOfBytes); }

TEST_P(EveryBoard, SurvivesACameraThatIsUnplugged) { expect_survives_camera_loss(board()); }
TEST_P(EveryBoard, SurvivesGarbageOnAllLines) { expect_survives_garbage(board()); }
TEST_P(EveryBoard, SurvivesOdometryThatStops) { expect_survives_odometry_loss(board()); }
TEST_P(EveryBoard, SurvivesLinesThatAreCut) { expect_survives_cut_lines(board()); }

TEST_P(EveryBoard, CountsNoMoreInstructionsForAFullTableThanCommitted) { GetParam().count(PoseCorrected::kNo); }
TEST_P(EveryBoard, CountsNoMoreInstructionsForACorrectedPoseThanCommitted) { GetParam().count(PoseCorrected::kYes); }

}  // namespace
}  // namespace fencepost::test
