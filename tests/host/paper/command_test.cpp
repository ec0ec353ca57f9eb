// `fencepost paper` as its users run it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "host/segment/image_file.hpp"
#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

TEST(PaperCommand, WritesAPageIntoANewFolder) {
  const Outcome run = shell("fencepost paper -o deep/er --scenes 1 --single 0 --seed 3");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "wrote deep/er/index.html; open it in a browser\n");
  EXPECT_TRUE(holds(slurp("deep/er/index.html"), "has seed 3"));
  EXPECT_TRUE(holds(slurp("deep/er/fig10.csv"), "landmark,result"));
}

TEST(PaperCommand, LeavesOtherFilesOfAFolderAlone) {
  const Outcome run =
      shell("mkdir p; echo mine >p/notes; echo old >p/index.html; fencepost paper -o p --scenes 1 --single 0");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(slurp("p/notes"), "mine\n");
  EXPECT_TRUE(holds(slurp("p/index.html"), "<!DOCTYPE html>"));
}

TEST(PaperCommand, SaysBeforeItsWorkThatItCannotWrite) {
  Outcome run = shell("echo x >file; fencepost paper -o file");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(holds(run.err, "cannot write into file: it is a file; choose another folder with -o"));
  EXPECT_EQ(slurp("file"), "x\n");
  run = shell("echo x >file; fencepost paper -o file/below");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(holds(run.err, "cannot write into file/below: "));
  run = shell("fencepost paper -o /proc/nowhere");
  EXPECT_EQ(run.exit_code, 4);
}

TEST(PaperCommand, RefusesScenesThatAreNone) {
  for (const std::string option : {"--scenes 0", "--scenes x", "--seed -1", "more"}) {
    const Outcome run = shell("fencepost paper " + option);
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_EQ(run.out, "");
  }
}

TEST(PaperCommand, EvaluatesARecordedRun) {
  const std::string run_and_truth =
      " --log " + recording("blocks_arc.log") + " --scene " + recording("blocks_arc.json");
  const Outcome run = shell("fencepost paper -o p" + run_and_truth);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(slurp("p/index.html"), "on one run: blocks_arc.log, "));
}

TEST(PaperCommand, ShowsTheRunsOwnPhotographs) {
  std::filesystem::create_directory(folder() / "photos");
  const cv::Mat photograph(208, 316, CV_8UC3, cv::Scalar(10, 200, 30));
  for (int i = 0; i < 75; ++i) {
    spill(folder() / "photos" / fmt::format("{:03}.png", i), encode_png(photograph));
  }
  const std::string paper = "fencepost paper -o p --images photos --log " + recording("blocks_arc.log") + " --scene " +
                            recording("blocks_arc.json");
  const Outcome run = shell(paper);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(slurp("p/index.html"), "real images are the photographs of the run"));
  const cv::Mat shown = read_image((folder() / "p/fig04_input.png").string());
  ASSERT_EQ(shown.cols, 632);
  EXPECT_EQ(shown.at<cv::Vec3b>(100, 100), cv::Vec3b(10, 200, 30));
  EXPECT_TRUE(ends(shell("rm photos/07*; " + paper), 3, "photos: 70 images, but the run has a frame 70"));
  const Outcome none = shell("fencepost paper --images photos");
  EXPECT_EQ(none.exit_code, 2);
}

TEST(PaperCommand, SaysWhatIsWrongWithARun) {
  const std::string scene = recording("blocks_arc.json");
  Outcome run = shell("fencepost paper --scene " + scene);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(holds(run.err, "--log and --scene belong together"));
  run = shell("fencepost paper --log missing.log --scene " + scene);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(holds(run.err, "cannot read missing.log"));
  run = shell("echo hello >run.log; fencepost paper --log run.log --scene " + scene + "; ls");
  EXPECT_TRUE(holds(run.err, "run.log: fewer than 8 frames with a pose"));
  run = shell("echo hello >run.log; fencepost paper --log run.log --scene " + scene);
  EXPECT_EQ(run.exit_code, 3);
}

TEST(PaperCommand, HelpsWithOptionsThenAnExample) {
  const Outcome run = shell("fencepost paper --help");
  EXPECT_EQ(run.exit_code, 0);
  const std::size_t example = run.out.find("fencepost paper -o paper");
  EXPECT_NE(example, std::string::npos);
  EXPECT_LT(run.out.find("--seed N"), example);
}

}  // namespace
}  // namespace fencepost::host
