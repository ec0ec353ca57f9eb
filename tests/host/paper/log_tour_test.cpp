#include "host/paper/log_tour.hpp"

#include <gtest/gtest.h>

#include "host/paper/blocks_world.hpp"
#include "host/paper/paper.hpp"
#include "tests/host/paper/worlds.hpp"

namespace fencepost::host {
namespace {

TEST(TourOfLog, FindsOutWhatTheSimulatorKnew) {
  const Tour driven = drive(blocks_world(BlocksWorld::kPaperLike, 3, false));
  const Tour read = tour_of_log(driven.log, driven.scene);
  ASSERT_EQ(read.frames.size(), driven.frames.size());
  std::size_t hidden = 0;
  std::size_t differing = 0;
  for (std::size_t f = 0; f < read.frames.size(); ++f) {
    EXPECT_EQ(read.poses[f], driven.poses[f]);
    ASSERT_EQ(read.images[f].truths.size(), driven.images[f].truths.size());
    for (std::size_t b = 0; b < read.images[f].truths.size(); ++b) {
      const BlobTruth& found = read.images[f].truths[b];
      const BlobTruth& known = driven.images[f].truths[b];
      EXPECT_EQ(found.object, known.object) << f;
      const HiddenEnds ends = read.hidden[f][*known.object];
      const HiddenEnds truth = driven.hidden[f][*known.object];
      // The log's poses are rounded, which moves an end by up to a pixel once in a while.
      differing += (ends.left != truth.left ? 1U : 0U) + (ends.right != truth.right ? 1U : 0U);
      hidden += ends.left || ends.right ? 1U : 0U;
    }
  }
  EXPECT_GT(hidden, 50U);
  EXPECT_LE(differing, 2U);
}

TEST(TourOfLog, GivesNoOneARegionOfTheBackground) {
  Scene scene = testing::two_squares();
  const Tour driven = drive(scene);
  scene.objects.pop_back();  // the truth knows nothing of the yellow block
  const Tour read = tour_of_log(driven.log, scene);
  std::size_t nobodys = 0;
  for (const BlobTruth& truth : read.images[0].truths) nobodys += truth.object ? 0U : 1U;
  EXPECT_EQ(nobodys, 1U);
}

TEST(TourOfLog, LeavesOutFramesWithoutOdometry) {
  const Tour driven = drive(testing::two_squares());
  std::string log;
  std::size_t begin = 0;
  for (std::size_t end = driven.log.find('\n'); end != std::string::npos; end = driven.log.find('\n', begin)) {
    const std::string line = driven.log.substr(begin, end + 1 - begin);
    if (!line.starts_with("$FPODO,0.2")) log += line;
    begin = end + 1;
  }
  EXPECT_EQ(driven.frames.size(), 3U);
  EXPECT_EQ(tour_of_log(log, driven.scene).frames.size(), 2U);
  EXPECT_TRUE(tour_of_log("", driven.scene).frames.empty());
  EXPECT_TRUE(tour_of_log("no log at all\n", driven.scene).frames.empty());
}

TEST(TourOfLog, InterpolatesBetweenPoses) {
  // Samples come every 20 ms; exposures 10 ms before a sample lie between two. From 0.1 s on the robot turns by
  // 0.25 rad in 0.1 s, so at 0.19 s it is at 0.15 + 0.9 * 0.25.
  const Tour driven = drive(testing::two_squares());
  Scene late = testing::two_squares();
  late.camera.latency = base::Duration::nearest(0.01);
  std::string log = driven.log;
  const std::size_t camera = log.find("$FPCAM");
  log.erase(camera, log.find('\n', camera) + 1 - camera);  // then the scene's calibration counts
  const Tour read = tour_of_log(log, late);
  ASSERT_EQ(read.frames.size(), 2U);  // the first one was exposed before the odometry began
  EXPECT_NEAR(believed_pose(read, 0).heading, 0.9 * 0.15, 2e-4);
  EXPECT_NEAR(believed_pose(read, 1).heading, 0.15 + 0.9 * 0.25, 2e-4);
}

PaperOptions of_run(const Tour& tour) {
  PaperOptions options;
  options.run = PaperRun{"a <run>.log", tour};
  return options;
}

TEST(WritePaperOfARun, ShowsThatRunAlone) {
  const Tour driven = drive(blocks_world(BlocksWorld::kFigures, 2));
  const std::vector<PaperFile> files = write_paper(of_run(tour_of_log(driven.log, driven.scene)));
  EXPECT_NE(files.front().bytes.find("a &lt;run&gt;.log, 75 images"), std::string::npos);
  for (const PaperFile& file : files) {
    if (file.name != "fig10.csv") continue;
    EXPECT_NE(file.bytes.find("average,all,cylinder,"), std::string::npos);
    EXPECT_NE(file.bytes.find(",150,"), std::string::npos);  // two landmarks in 75 images
  }
}

TEST(WritePaperOfARun, RefusesWhatIsTooLittle) {
  const Tour driven = drive(testing::two_squares());  // three frames
  EXPECT_THROW(write_paper(of_run(driven)), std::runtime_error);
  Tour one = drive(blocks_world(BlocksWorld::kFigures, 2));
  one.scene.objects.resize(1);
  EXPECT_THROW(write_paper(of_run(one)), std::runtime_error);
}

}  // namespace
}  // namespace fencepost::host
