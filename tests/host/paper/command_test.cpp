// `fencepost paper` as its users run it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "host/segment/image_file.hpp"
#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using testing::Folder;
using testing::Outcome;
using testing::recording;
using testing::shell;
using testing::slurp;
using testing::spill;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(PaperCommand, WritesAPageIntoANewFolder) {
  const Folder folder;
  const Outcome run = shell(folder, "fencepost paper -o deep/er --scenes 1 --single 0 --seed 3");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "wrote deep/er/index.html; open it in a browser\n");
  EXPECT_TRUE(holds(slurp(folder.path() / "deep/er/index.html"), "has seed 3"));
  EXPECT_TRUE(holds(slurp(folder.path() / "deep/er/fig10.csv"), "landmark,result"));
}

TEST(PaperCommand, LeavesOtherFilesOfAFolderAlone) {
  const Folder folder;
  const Outcome run =
      shell(folder, "mkdir p; echo mine >p/notes; echo old >p/index.html; fencepost paper -o p --scenes 1 --single 0");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(slurp(folder.path() / "p/notes"), "mine\n");
  EXPECT_TRUE(holds(slurp(folder.path() / "p/index.html"), "<!DOCTYPE html>"));
}

TEST(PaperCommand, SaysBeforeItsWorkThatItCannotWrite) {
  const Folder folder;
  Outcome run = shell(folder, "echo x >file; fencepost paper -o file");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(holds(run.err, "cannot write into file: it is a file; choose another folder with -o")) << run.err;
  EXPECT_EQ(slurp(folder.path() / "file"), "x\n");
  run = shell(folder, "echo x >file; fencepost paper -o file/below");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(holds(run.err, "cannot write into file/below: ")) << run.err;
  run = shell(folder, "fencepost paper -o /proc/nowhere");
  EXPECT_EQ(run.exit_code, 4);
}

TEST(PaperCommand, RefusesScenesThatAreNone) {
  const Folder folder;
  for (const std::string option : {"--scenes 0", "--scenes x", "--seed -1", "more"}) {
    const Outcome run = shell(folder, "fencepost paper " + option);
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_EQ(run.out, "");
  }
}

TEST(PaperCommand, EvaluatesARecordedRun) {
  const Folder folder;
  const std::string run_and_truth =
      " --log " + recording("blocks_arc.log") + " --scene " + recording("blocks_arc.json");
  const Outcome run = shell(folder, "fencepost paper -o p" + run_and_truth);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(slurp(folder.path() / "p/index.html"), "on one run: blocks_arc.log, "));
}

TEST(PaperCommand, ShowsTheRunsOwnPhotographs) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "photos");
  const cv::Mat photograph(208, 316, CV_8UC3, cv::Scalar(10, 200, 30));
  for (int i = 0; i < 75; ++i) {
    spill(folder.path() / "photos" / fmt::format("{:03}.png", i), encode_png(photograph));
  }
  const std::string paper = "fencepost paper -o p --images photos --log " + recording("blocks_arc.log") + " --scene " +
                            recording("blocks_arc.json");
  const Outcome run = shell(folder, paper);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(slurp(folder.path() / "p/index.html"), "real images are the photographs of the run"));
  const cv::Mat shown = read_image((folder.path() / "p/fig04_input.png").string());
  ASSERT_EQ(shown.cols, 632);
  EXPECT_EQ(shown.at<cv::Vec3b>(100, 100), cv::Vec3b(10, 200, 30));
  const Outcome few = shell(folder, "rm photos/07*; " + paper);
  EXPECT_EQ(few.exit_code, 3);
  EXPECT_TRUE(holds(few.err, "photos: 70 images, but the run has a frame 70")) << few.err;
  const Outcome none = shell(folder, "fencepost paper --images photos");
  EXPECT_EQ(none.exit_code, 2);
}

TEST(PaperCommand, SaysWhatIsWrongWithARun) {
  const Folder folder;
  const std::string scene = recording("blocks_arc.json");
  Outcome run = shell(folder, "fencepost paper --scene " + scene);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(holds(run.err, "--log and --scene belong together")) << run.err;
  run = shell(folder, "fencepost paper --log missing.log --scene " + scene);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(holds(run.err, "cannot read missing.log")) << run.err;
  run = shell(folder, "echo hello >run.log; fencepost paper --log run.log --scene " + scene + "; ls");
  EXPECT_TRUE(holds(run.err, "run.log: fewer than 8 frames with a pose")) << run.err;
  run = shell(folder, "echo hello >run.log; fencepost paper --log run.log --scene " + scene);
  EXPECT_EQ(run.exit_code, 3);
}

TEST(PaperCommand, HelpsWithOptionsThenAnExample) {
  const Folder folder;
  const Outcome run = shell(folder, "fencepost paper --help");
  EXPECT_EQ(run.exit_code, 0);
  const std::size_t example = run.out.find("fencepost paper -o paper");
  EXPECT_NE(example, std::string::npos);
  EXPECT_LT(run.out.find("--seed N"), example);
}

}  // namespace
}  // namespace fencepost::host
