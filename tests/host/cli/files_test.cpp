// What happens to files when things go wrong.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <vector>

#include "tests/host/cli/process.hpp"

namespace fencepost::host {
namespace {

using testing::Folder;
using testing::Outcome;
using testing::Process;
using testing::recording;
using testing::shell;
using testing::slurp;
using testing::spill;

const std::string kReplay = "fencepost replay " + recording("approach_stop.log");

std::size_t entries(const Folder& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()));
}

TEST(Output, AFullDiskIsNoticed) {
  const Folder folder;
  for (const std::string& line :
       std::vector<std::string>{kReplay + " -o /dev/full", kReplay + " >/dev/full", kReplay + " --json >/dev/full",
                                kReplay + " --write-log /dev/full", "fencepost demo -o /dev/full",
                                "fencepost simulate " + recording("approach_stop.json") + " -o /dev/full"}) {
    const Outcome run = shell(folder, line);
    EXPECT_EQ(run.exit_code, 4) << line;
    EXPECT_NE(run.err.find("No space left on device; free some space"), std::string::npos) << run.err;
  }
}

TEST(Output, AMissingFolderIsNoticed) {
  const Outcome run = shell(Folder(), kReplay + " -o no/such/place");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("create the folder first"), std::string::npos) << run.err;
}

TEST(Output, AFolderIsNotReplaced) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "there");
  EXPECT_EQ(shell(folder, kReplay + " -o there").exit_code, 4);
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "there"));
}

// The disk is played by a limit on file size: 1 block of 512 or 1024 bytes, far less than the result.
TEST(Output, AFailedWriteKeepsTheOldFileAndLeavesNoOther) {
  const Folder folder;
  spill(folder.path() / "result.json", "old");
  const Outcome run = shell(folder, "(trap '' XFSZ; ulimit -f 1; " + kReplay + " --json -o result.json)");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(slurp(folder.path() / "result.json"), "old");
  EXPECT_EQ(entries(folder), 1U);
}

TEST(Output, ReplacesAFileAndKeepsItsMode) {
  const Folder folder;
  spill(folder.path() / "result", "old");
  const Outcome run = shell(folder, "chmod 640 result; " + kReplay + " -o result && stat -c %a result");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "640\n");
  EXPECT_NE(slurp(folder.path() / "result"), "old");
  EXPECT_EQ(entries(folder), 1U);
}

TEST(Output, ALinkStaysALink) {
  const Folder folder;
  spill(folder.path() / "real", "old");
  std::filesystem::create_symlink("real", folder.path() / "link");
  EXPECT_EQ(shell(folder, kReplay + " -o link").exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_NE(slurp(folder.path() / "real"), "old");
}

TEST(Output, AClosedPipeIsQuiet) {
  const Folder folder;
  // The reader is gone well before the writer starts.
  const Outcome run = shell(folder, "{ sleep 0.3; " + kReplay + " --json; echo $? >code; } | true; wait");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(slurp(folder.path() / "code"), "0\n");
}

// A shell would call death by the signal 130 as well; only the parent can tell the two apart.
TEST(Interrupt, ExitsWith130) {
  const Folder folder;
  Process replay(folder, {"replay", "-"});
  ::usleep(300'000);  // it now waits for the input that never comes
  EXPECT_EQ(replay.end(SIGINT), 130);
}

}  // namespace
}  // namespace fencepost::host
