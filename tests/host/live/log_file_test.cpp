#include "host/live/log_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "tests/host/live/log_folder.hpp"

namespace fencepost::host {
namespace {

using LogFileTest = LogFolder;

LogFile opened(LogFileSettings settings) {
  linux::Opened<LogFile> log = LogFile::open(std::move(settings), at(0));
  EXPECT_TRUE(log) << log.problem();
  return std::move(*log);
}

TEST_F(LogFileTest, BytesAreInTheFileBeforeItIsClosed) {
  LogFile log = opened({path});
  const std::string bytes("any \0 byte \xff\r\nhalf a li", 22);
  ASSERT_FALSE(log.write(bytes, at(0)));
  EXPECT_EQ(contents(path), bytes);
  ASSERT_FALSE(log.write("ne\n", at(0)));
  EXPECT_EQ(contents(path), bytes + "ne\n");
  EXPECT_EQ(log.bytes(), bytes.size() + 3);
}

TEST_F(LogFileTest, NothingIsWrittenAfterClosing) {
  LogFile log = opened({path});
  ASSERT_FALSE(log.write("one\n", at(0)));
  ASSERT_FALSE(log.close());
  EXPECT_FALSE(log.write("two\n", at(1)));
  EXPECT_FALSE(log.close());
  EXPECT_EQ(contents(path), "one\n");
}

TEST_F(LogFileTest, AnExistingFileIsRefusedAndKept) {
  spill(path, "old");
  linux::Opened<LogFile> log = LogFile::open({path}, at(0));
  ASSERT_FALSE(log);
  EXPECT_EQ(log.problem(), "cannot create the log " + path +
                               ": File exists; choose another name, or move it away; a log is never overwritten");
  EXPECT_EQ(contents(path), "old");
}

TEST_F(LogFileTest, AnExistingFileIsOverwrittenWhenTold) {
  spill(path, "something longer");
  LogFile log = opened({.path = path, .overwrite = true});
  ASSERT_FALSE(log.write("new\n", at(0)));
  EXPECT_EQ(contents(path), "new\n");
}

// Before, both said that it was theirs, and the second emptied it.
TEST_F(LogFileTest, AFileThatAnotherRunWritesIsRefusedAndKept) {
  LogFile first = opened({.path = path, .overwrite = true});
  ASSERT_FALSE(first.write("mine\n", at(0)));
  linux::Opened<LogFile> second = LogFile::open({.path = path, .overwrite = true}, at(0));
  ASSERT_FALSE(second);
  EXPECT_NE(second.problem().find("another run writes it; choose another name"), std::string::npos) << second.problem();
  EXPECT_EQ(contents(path), "mine\n");
  ASSERT_FALSE(first.close());
  EXPECT_TRUE(LogFile::open({.path = path, .overwrite = true}, at(0))) << "once it is closed";
}

// To open it for writing waits until somebody reads.
TEST_F(LogFileTest, APipeThatNobodyReadsIsSaid) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  linux::Opened<LogFile> log = LogFile::open({path}, at(0));
  ASSERT_FALSE(log);
  EXPECT_NE(log.problem().find("nobody reads this pipe; start its reader first"), std::string::npos) << log.problem();
  const linux::Descriptor reader(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  LogFile read = opened({path});
  ASSERT_FALSE(read.write("line\n", at(0)));
  char bytes[8] = {};
  EXPECT_EQ(::read(reader.get(), bytes, sizeof bytes), 5);
}

TEST_F(LogFileTest, AMissingFolderIsSaid) {
  linux::Opened<LogFile> log = LogFile::open({folder.file("no/run.log")}, at(0));
  ASSERT_FALSE(log);
  EXPECT_NE(log.problem().find("No such file or directory; create the folder first"), std::string::npos);
}

TEST_F(LogFileTest, AFolderIsNoLog) {
  for (const bool overwrite : {false, true}) {
    linux::Opened<LogFile> log = LogFile::open({.path = folder.file("."), .overwrite = overwrite}, at(0));
    EXPECT_FALSE(log);
  }
}

TEST(LogFile, AFullDiskIsSaidOnceAndForAll) {
  LogFile log = opened({"/dev/full"});
  for (int i = 0; i < 2; ++i) {
    const LogFile::Fault fault = log.write("line\n", at(0));
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->sentence,
              "cannot write the log /dev/full: No space left on device; free some space, or choose another disk; "
              "what was written before is kept");
  }
  EXPECT_TRUE(log.tend(at(5)));
  EXPECT_TRUE(log.close());
  EXPECT_EQ(log.bytes(), 0U);
}

// The kernel cuts the write that crosses the limit short and refuses the next one.
TEST_F(LogFileTest, WhatFitsIsKeptWhenTheFileCannotGrow) {
  LogFile log = opened({path});
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{10, old.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const LogFile::Fault fault = log.write("0123456789abc\n", at(0));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->sentence, "cannot write the log " + path +
                                 ": File too large; raise 'ulimit -f', or write smaller parts; what was written "
                                 "before is kept");
  EXPECT_EQ(contents(path), "0123456789");
  EXPECT_EQ(log.bytes(), 10U);
}

TEST_F(LogFileTest, APipeIsWrittenAsItIs) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::string heard;
  std::thread reader([&] { heard = contents(path); });
  {
    LogFile log = opened({path});
    EXPECT_FALSE(log.write("through\n", at(0)));
    EXPECT_FALSE(log.close());
  }
  reader.join();
  EXPECT_EQ(heard, "through\n");
}

TEST(PartPath, CountsBeforeTheExtension) {
  EXPECT_EQ(part_path("run.log", 1), "run.log");
  EXPECT_EQ(part_path("run.log", 2), "run-0002.log");
  EXPECT_EQ(part_path("a.b/run.tar.log", 12345), "a.b/run.tar-12345.log");
  EXPECT_EQ(part_path("/logs.d/run", 3), "/logs.d/run-0003");
  EXPECT_EQ(part_path(".hidden", 3), ".hidden-0003");
}

// 10 bytes reached by the third line (3 * 4 = 12): it is the last of its part.
TEST_F(LogFileTest, ALongPartEndsAtALineEnd) {
  LogFile log = opened({.path = path, .part_bytes = 10});
  for (const std::string_view portion : {"aaa\nb", "bb\ncc", "c\nddd\nee", "e\n"}) {
    ASSERT_FALSE(log.write(portion, at(0)));
  }
  EXPECT_EQ(contents(path), "aaa\nbbb\nccc\n");
  EXPECT_EQ(contents(folder.file("run-0002.log")), "ddd\neee\n");
  EXPECT_EQ(log.parts(), 2U);
  EXPECT_EQ(log.path(), folder.file("run-0002.log"));
  EXPECT_EQ(log.bytes(), 20U);
}

TEST_F(LogFileTest, OneWriteMayFillManyParts) {
  LogFile log = opened({.path = path, .part_bytes = 4});
  ASSERT_FALSE(log.write("aaa\nbbb\nccc\n", at(0)));
  EXPECT_EQ(contents(path), "aaa\n");
  EXPECT_EQ(contents(folder.file("run-0002.log")), "bbb\n");
  EXPECT_EQ(contents(folder.file("run-0003.log")), "ccc\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("run-0004.log")));
}

TEST_F(LogFileTest, AnOldPartEndsAtALineEnd) {
  LogFile log = opened({.path = path, .part_age = base::milliseconds(2000)});
  ASSERT_FALSE(log.write("one\ntw", at(1.9)));
  ASSERT_FALSE(log.write("o\nthree\n", at(2.0)));
  ASSERT_FALSE(log.write("four\n", at(3.9)));
  ASSERT_FALSE(log.write("five\n", at(9)));
  EXPECT_EQ(contents(path), "one\ntwo\n");
  EXPECT_EQ(contents(folder.file("run-0002.log")), "three\nfour\n");
  EXPECT_EQ(contents(folder.file("run-0003.log")), "five\n");
}

TEST_F(LogFileTest, LaterPartsBeginAsTold) {
  int calls = 0;
  LogFile log =
      opened({.path = path, .part_bytes = 4, .part_start = [&] { return "call " + std::to_string(++calls) + "\n"; }});
  ASSERT_FALSE(log.write("aaa\nbbb\n", at(0)));
  EXPECT_EQ(contents(path), "aaa\n");
  EXPECT_EQ(contents(folder.file("run-0002.log")), "call 1\nbbb\n");
}

TEST_F(LogFileTest, PartsOfAnEarlierRunAreKept) {
  spill(folder.file("run-0002.log"), "old");
  LogFile log = opened({.path = path, .part_bytes = 4});
  ASSERT_FALSE(log.write("aaa\nbbb\n", at(0)));
  EXPECT_EQ(contents(folder.file("run-0002.log")), "old");
  EXPECT_EQ(contents(folder.file("run-0003.log")), "bbb\n");
  EXPECT_EQ(log.parts(), 2U);
}

TEST_F(LogFileTest, AFolderThatGoesAwayIsSaidAtTheNextPart) {
  const std::string inside = folder.file("usb");
  std::filesystem::create_directory(inside);
  LogFile log = opened({.path = inside + "/run.log", .part_bytes = 4});
  ASSERT_FALSE(log.write("aaa\n", at(0)));
  std::filesystem::remove_all(inside);
  const LogFile::Fault fault = log.write("bbb\n", at(0));
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->sentence.find("cannot create the log " + inside + "/run-0002.log: No such file"), std::string::npos)
      << fault->sentence;
}

}  // namespace
}  // namespace fencepost::host
