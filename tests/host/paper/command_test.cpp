// `fencepost paper` as its users run it.
#include <gtest/gtest.h>

#include <string>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using testing::Folder;
using testing::Outcome;
using testing::recording;
using testing::shell;
using testing::slurp;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(PaperCommand, WritesAPageIntoANewFolder) {
  const Folder folder;
  const Outcome run = shell(folder, "fencepost paper -o deep/er --scenes 1 --seed 3");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "wrote deep/er/index.html; open it in a browser\n");
  EXPECT_TRUE(holds(slurp(folder.path() / "deep/er/index.html"), "has seed 3"));
  EXPECT_TRUE(holds(slurp(folder.path() / "deep/er/fig10.csv"), "landmark,result"));
}

TEST(PaperCommand, LeavesOtherFilesOfAFolderAlone) {
  const Folder folder;
  const Outcome run =
      shell(folder, "mkdir p; echo mine >p/notes; echo old >p/index.html; fencepost paper -o p --scenes 1");
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

TEST(PaperCommand, HelpsWithAnExampleFirst) {
  const Folder folder;
  const Outcome run = shell(folder, "fencepost paper --help");
  EXPECT_EQ(run.exit_code, 0);
  const std::size_t example = run.out.find("fencepost paper -o paper");
  EXPECT_LT(example, run.out.find("--seed N"));
}

}  // namespace
}  // namespace fencepost::host
