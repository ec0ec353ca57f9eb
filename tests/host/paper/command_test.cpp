// `fencepost paper` as its users run it.
#include <gtest/gtest.h>

#include <string>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using testing::Folder;
using testing::Outcome;
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

TEST(PaperCommand, HelpsWithAnExampleFirst) {
  const Folder folder;
  const Outcome run = shell(folder, "fencepost paper --help");
  EXPECT_EQ(run.exit_code, 0);
  const std::size_t example = run.out.find("fencepost paper -o paper");
  EXPECT_LT(example, run.out.find("--seed N"));
}

}  // namespace
}  // namespace fencepost::host
