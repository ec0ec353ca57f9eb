// Files when things go wrong.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vector>

#include "hal/linux/descriptor.hpp"
#include "host/cli/interrupt.hpp"
#include "tests/host/cli/process.hpp"

namespace fencepost::host {
namespace {

using testing::anybody_can_run;
using testing::as_anybody;
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
  // The reader has gone, and says so, before the writer starts.
  const Outcome run = shell(folder, "mkfifo gone; { read -r _ < gone; " + kReplay +
                                        " --json; echo $? >code; } | { exec <&-; echo > gone; }; wait");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(slurp(folder.path() / "code"), "0\n");
}

// Opened by its name, standard output would be replaced by a file of that name, and what others appended lost.
TEST(Output, StandardOutputByAnotherNameIsAppendedTo) {
  const Folder folder;
  const std::size_t once = shell(folder, kReplay).out.size();
  ASSERT_GT(once, 0U);
  spill(folder.path() / "all", "earlier\n");
  std::size_t expected = 8;
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "-"}) {
    const Outcome run = shell(folder, kReplay + " -o " + name + " >> all");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    expected += once;
    EXPECT_EQ(slurp(folder.path() / "all").size(), expected) << name;
  }
  EXPECT_TRUE(slurp(folder.path() / "all").starts_with("earlier\n"));
  const Outcome both = shell(folder, kReplay + " -o /dev/stdout --write-log -");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.out, "");
}

TEST(Output, AnInputIsNotReplacedByItsResult) {
  const Folder folder;
  shell(folder, "cp " + recording("approach_stop.log") + " run.log; ln run.log other; ln -s run.log link");
  const std::string before = slurp(folder.path() / "run.log");
  for (const char* line : {"run.log -o run.log", "run.log -o other", "run.log -o link", "- -o run.log < run.log",
                           "run.log --write-log ./run.log"}) {
    const Outcome run = shell(folder, std::string("fencepost replay ") + line);
    EXPECT_EQ(run.exit_code, 2) << line;
    EXPECT_NE(run.err.find("is also the input"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(slurp(folder.path() / "run.log"), before) << line;
  }
}

TEST(Output, WhatADanglingLinkLeadsToIsMade) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "deep");
  std::filesystem::create_symlink("deep/second", folder.path() / "link");
  std::filesystem::create_symlink("real", folder.path() / "deep/second");
  const Outcome run = shell(folder, kReplay + " -o link");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "deep/second"));
  EXPECT_NE(slurp(folder.path() / "deep/real"), "");
}

TEST(Output, ANameMayBeAsLongAsNamesCanBe) {
  const Folder folder;
  const std::string name(255, 'n');
  EXPECT_EQ(shell(folder, kReplay + " -o " + name).exit_code, 0);
  EXPECT_NE(slurp(folder.path() / name), "");
  const Outcome longer = shell(folder, kReplay + " -o " + name + "n");
  EXPECT_EQ(longer.exit_code, 4);
  EXPECT_NE(longer.err.find("File name too long"), std::string::npos) << longer.err;
}

TEST(Output, AFileThatMayNotBeWrittenStays) {
  const Folder folder;
  if (!anybody_can_run(folder)) GTEST_SKIP() << "only root may run the program where it was built";
  spill(folder.path() / "result", "precious");
  const Outcome run = shell(folder, as_anybody(folder) + "chmod 444 result; " + kReplay + " -o result");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("you may not write there"), std::string::npos) << run.err;
  EXPECT_EQ(slurp(folder.path() / "result"), "precious");
}

// A shell would call death by the signal 130 as well; only the parent can tell the two apart. Opening the pipe waits
// until the program has, too: then it waits for input that never comes.
TEST(Interrupt, ExitsWith130) {
  const Folder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Process replay(folder, {"replay", "pipe"});
  const linux::Descriptor held(::open(pipe.c_str(), O_WRONLY | O_CLOEXEC));
  ASSERT_TRUE(held.open());
  EXPECT_EQ(replay.end(SIGINT), 130);
}

/// As in write_output, when the signal comes.
void write_and_raise(const std::string& file, int signal) {
  cli::handle_interrupts();
  const cli::RemoveOnInterrupt guard(file);
  spill(file, "half");
  ::raise(signal);
}

TEST(Interrupt, NothingHalfWrittenIsLeft) {
  const Folder folder;
  const std::string file = (folder.path() / "result.part").string();
  EXPECT_EXIT(write_and_raise(file, SIGINT), ::testing::ExitedWithCode(130), "");
  EXPECT_EQ(entries(folder), 0U);
  EXPECT_EXIT(write_and_raise(file, SIGTERM), ::testing::KilledBySignal(SIGTERM), "");
  EXPECT_EQ(entries(folder), 0U);
  EXPECT_EXIT(write_and_raise(file, SIGHUP), ::testing::KilledBySignal(SIGHUP), "");
  EXPECT_EQ(entries(folder), 0U);
}

// A closed stream must not become the file that is written: messages would go into it.
TEST(ClosedStreams, MessagesDoNotGoIntoTheResult) {
  const Folder folder;
  const std::string first = "head -n 200 " + recording("approach_stop.log") + " > cut.log; ";
  const std::string bad = first + "echo '$FPODO,bad*0000' >> cut.log; fencepost replay cut.log --json -o ";
  EXPECT_EQ(shell(folder, bad + "open.json").exit_code, 0);
  for (const char* closed : {">&- 2>&-", "<&- >&- 2>&-", "2>&-"}) {
    EXPECT_EQ(shell(folder, bad + "closed.json " + closed).exit_code, 0) << closed;
    EXPECT_EQ(slurp(folder.path() / "closed.json"), slurp(folder.path() / "open.json")) << closed;
  }
}

TEST(ClosedStreams, ARecordingHoldsOnlyWhatWasRecorded) {
  const Folder folder;
  const std::string record = "fencepost record - -o ";
  EXPECT_EQ(shell(folder, "cat " + recording("approach_stop.log") + " | " + record + "run.log >&- 2>&-").exit_code, 0);
  EXPECT_EQ(slurp(folder.path() / "run.log"), slurp(FENCEPOST_SOURCE_DIR "/host/share/recordings/approach_stop.log"));
  const Outcome deaf = shell(folder, record + "deaf.log --seconds 20 <&-");
  EXPECT_EQ(deaf.exit_code, 3);
  EXPECT_NE(deaf.err.find("cannot read standard input: Bad file descriptor"), std::string::npos) << deaf.err;
  EXPECT_EQ(slurp(folder.path() / "deaf.log"), "");
}

TEST(ClosedStreams, AResultThatGoesNowhereIsAnError) {
  const Outcome run = shell(Folder(), kReplay + " >&-");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("cannot write standard output"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace fencepost::host
