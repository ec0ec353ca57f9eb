// Files when things go wrong.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <vector>

#include "hal/linux/descriptor.hpp"
#include "host/cli/interrupt.hpp"
#include "tests/host/cli/process.hpp"

namespace fencepost::host {
namespace {

using namespace testing;

const std::string kReplay = "fencepost replay " + recording("approach_stop.log");

std::size_t entries() {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder()), std::filesystem::directory_iterator()));
}

TEST(Output, AFullDiskIsNoticed) {
  for (const std::string& line :
       std::vector<std::string>{kReplay + " -o /dev/full", kReplay + " >/dev/full", kReplay + " --json >/dev/full",
                                kReplay + " --write-log /dev/full", "fencepost demo -o /dev/full",
                                "fencepost simulate " + recording("approach_stop.json") + " -o /dev/full"}) {
    const Outcome run = shell(line);
    EXPECT_EQ(run.exit_code, 4) << line;
    EXPECT_TRUE(holds(run.err, "No space left on device; free some space"));
  }
}

TEST(Output, AMissingFolderIsNoticed) {
  EXPECT_TRUE(ends(shell(kReplay + " -o no/such/place"), 4, "create the folder first"));
}

TEST(Output, AFolderIsNotReplaced) {
  std::filesystem::create_directory(folder() / "there");
  EXPECT_EQ(shell(kReplay + " -o there").exit_code, 4);
  EXPECT_TRUE(std::filesystem::is_directory(folder() / "there"));
}

// The disk is played by a limit on file size: 1 block of 512 or 1024 bytes, far less than the result.
TEST(Output, AFailedWriteKeepsTheOldFileAndLeavesNoOther) {
  spill("result.json", "old");
  const Outcome run = shell("(trap '' XFSZ; ulimit -f 1; " + kReplay + " --json -o result.json)");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(slurp("result.json"), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST(Output, ReplacesAFileAndKeepsItsMode) {
  spill("result", "old");
  const Outcome run = shell("chmod 640 result; " + kReplay + " -o result && stat -c %a result");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "640\n");
  EXPECT_NE(slurp("result"), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST(Output, ALinkStaysALink) {
  spill("real", "old");
  std::filesystem::create_symlink("real", folder() / "link");
  EXPECT_EQ(shell(kReplay + " -o link").exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link"));
  EXPECT_NE(slurp("real"), "old");
}

TEST(Output, AClosedPipeIsQuiet) {
  // The reader has gone, and says so, before the writer starts.
  const Outcome run = shell("mkfifo gone; { read -r _ < gone; " + kReplay +
                            " --json; echo $? >code; } | { exec <&-; echo > gone; }; wait");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(slurp("code"), "0\n");
}

// Opened by its name, standard output would be replaced by a file of that name, and what others appended lost.
TEST(Output, StandardOutputByAnotherNameIsAppendedTo) {
  const std::size_t once = shell(kReplay).out.size();
  ASSERT_GT(once, 0U);
  spill("all", "earlier\n");
  std::size_t expected = 8;
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "-"}) {
    const Outcome run = shell(kReplay + " -o " + name + " >> all");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    expected += once;
    EXPECT_EQ(slurp("all").size(), expected) << name;
  }
  EXPECT_TRUE(slurp("all").starts_with("earlier\n"));
  const Outcome both = shell(kReplay + " -o /dev/stdout --write-log -");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.out, "");
}

TEST(Output, AnInputIsNotReplacedByItsResult) {
  shell("cp " + recording("approach_stop.log") + " run.log; ln run.log other; ln -s run.log link");
  const std::string before = slurp("run.log");
  for (const char* line : {"run.log -o run.log", "run.log -o other", "run.log -o link", "- -o run.log < run.log",
                           "run.log --write-log ./run.log"}) {
    const Outcome run = shell(std::string("fencepost replay ") + line);
    EXPECT_EQ(run.exit_code, 2) << line;
    EXPECT_TRUE(holds(run.err, "is also the input"));
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(slurp("run.log"), before) << line;
  }
}

TEST(Output, WhatADanglingLinkLeadsToIsMade) {
  std::filesystem::create_directory(folder() / "deep");
  std::filesystem::create_symlink("deep/second", folder() / "link");
  std::filesystem::create_symlink("real", folder() / "deep/second");
  const Outcome run = shell(kReplay + " -o link");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "deep/second"));
  EXPECT_NE(slurp("deep/real"), "");
}

TEST(Output, ANameMayBeAsLongAsNamesCanBe) {
  const std::string name(255, 'n');
  EXPECT_EQ(shell(kReplay + " -o " + name).exit_code, 0);
  EXPECT_NE(slurp(folder() / name), "");
  EXPECT_TRUE(ends(shell(kReplay + " -o " + name + "n"), 4, "File name too long"));
}

TEST(Output, AFileThatMayNotBeWrittenStays) {
  if (!anybody_can_run()) GTEST_SKIP() << "only root may run the program where it was built";
  spill("result", "precious");
  EXPECT_TRUE(ends(shell(as_anybody() + "chmod 444 result; " + kReplay + " -o result"), 4, "you may not write there"));
  EXPECT_EQ(slurp("result"), "precious");
}

// A shell would call death by the signal 130 as well; only the parent can tell the two apart. Opening the pipe waits
// until the program has, too: then it waits for input that never comes.
TEST(Interrupt, ExitsWith130) {
  const std::string pipe = (folder() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Process replay(test_folder(), {"replay", "pipe"});
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
  const std::string file = (folder() / "result.part").string();
  EXPECT_EXIT(write_and_raise(file, SIGINT), ::testing::ExitedWithCode(130), "");
  EXPECT_EQ(entries(), 0U);
  EXPECT_EXIT(write_and_raise(file, SIGTERM), ::testing::KilledBySignal(SIGTERM), "");
  EXPECT_EQ(entries(), 0U);
  EXPECT_EXIT(write_and_raise(file, SIGHUP), ::testing::KilledBySignal(SIGHUP), "");
  EXPECT_EQ(entries(), 0U);
}

// A closed stream must not become the file that is written: messages would go into it.
TEST(ClosedStreams, MessagesDoNotGoIntoTheResult) {
  const std::string first = "head -n 200 " + recording("approach_stop.log") + " > cut.log; ";
  const std::string bad = first + "echo '$FPODO,bad*0000' >> cut.log; fencepost replay cut.log --json -o ";
  EXPECT_EQ(shell(bad + "open.json").exit_code, 0);
  for (const char* closed : {">&- 2>&-", "<&- >&- 2>&-", "2>&-"}) {
    EXPECT_EQ(shell(bad + "closed.json " + closed).exit_code, 0) << closed;
    EXPECT_EQ(slurp("closed.json"), slurp("open.json")) << closed;
  }
}

TEST(ClosedStreams, ARecordingHoldsOnlyWhatWasRecorded) {
  const std::string record = "fencepost record - -o ";
  EXPECT_EQ(shell("cat " + recording("approach_stop.log") + " | " + record + "run.log >&- 2>&-").exit_code, 0);
  EXPECT_EQ(slurp("run.log"), slurp(FENCEPOST_SOURCE_DIR "/host/share/recordings/approach_stop.log"));
  const Outcome deaf = shell(record + "deaf.log --seconds 20 <&-");
  EXPECT_EQ(deaf.exit_code, 3);
  EXPECT_TRUE(holds(deaf.err, "cannot read standard input: Bad file descriptor"));
  EXPECT_EQ(slurp("deaf.log"), "");
}

TEST(ClosedStreams, AResultThatGoesNowhereIsAnError) {
  EXPECT_TRUE(ends(shell(kReplay + " >&-"), 4, "cannot write standard output"));
}

}  // namespace
}  // namespace fencepost::host
