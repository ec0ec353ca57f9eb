// When the log is brought to the disk. This program replaces fdatasync by one that counts, and fails on demand.

#include <atomic>
#include <cerrno>
#include <chrono>
#include <thread>

#include "tests/host/live/log_folder.hpp"

namespace {

std::atomic<int> syncs = 0;
std::atomic<int> failing = 0;
std::atomic<bool> slow = false;

}  // namespace

extern "C" int fdatasync(int /*fd*/) {
  while (slow) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ++syncs;
  if (failing == 0) return 0;
  errno = failing;
  return -1;
}

namespace fencepost::host {
namespace {

class LogSync : public LogFolder {
 protected:
  LogSync() { syncs = failing = 0; }
  /// Turns the loop at that time until the thread has synced so often; fails after ten seconds.
  void expect_syncs(int count, base::Time now) {
    for (int i = 0; i < 10'000 && (i == 0 || syncs < count); ++i) {
      EXPECT_FALSE(log->tend(now));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(syncs, count);
  }
  linux::Opened<LogFile> log = LogFile::open({path}, at(0));
};

TEST_F(LogSync, OnceASecondAsLongAsSomethingIsNew) {
  ASSERT_FALSE(log->write("one\n", at(0.5)));
  expect_syncs(0, at(0.9999));
  expect_syncs(1, at(1));
  expect_syncs(1, at(7));
  ASSERT_FALSE(log->write("two\n", at(7)));
  expect_syncs(2, at(7));
  ASSERT_FALSE(log->write("three\n", at(7.1)));
  expect_syncs(2, at(7.9));
}

TEST_F(LogSync, ClosingDoesItOnceMore) {
  ASSERT_FALSE(log->write("one\n", at(0)));
  ASSERT_FALSE(log->close());
  EXPECT_EQ(syncs, 1);
}

TEST_F(LogSync, ASlowDiskDoesNotHoldUpTheLoop) {
  slow = true;
  ASSERT_FALSE(log->write("one\n", at(0)));
  ASSERT_FALSE(log->tend(at(1)));
  ASSERT_FALSE(log->write("two\n", at(1.2)));
  ASSERT_FALSE(log->tend(at(1.5)));
  EXPECT_EQ(contents(path), "one\ntwo\n");
  EXPECT_EQ(syncs, 0);
  slow = false;
  expect_syncs(1, at(1.5));
}

TEST_F(LogSync, AnErrorOfTheDiskIsSaid) {
  failing = EIO;
  ASSERT_FALSE(log->write("one\n", at(0)));
  LogFile::Fault fault;
  for (int i = 0; i < 10'000 && !fault; ++i) {
    fault = log->tend(at(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->sentence, "cannot write the log " + path +
                                 ": Input/output error; look at the end of 'dmesg', or choose another disk; what was "
                                 "written before is kept");
}

TEST_F(LogSync, AnErrorOfClosingIsSaid) {
  failing = ENOSPC;
  ASSERT_FALSE(log->write("one\n", at(0)));
  const LogFile::Fault fault = log->close();
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->sentence.find("No space left on device"), std::string::npos);
}

// As devices and pipes do.
TEST_F(LogSync, WhatCannotBeSyncedIsNoError) {
  failing = EINVAL;
  ASSERT_FALSE(log->write("one\n", at(0)));
  EXPECT_FALSE(log->close());
}

TEST_F(LogSync, AFinishedPartIsSynced) {
  linux::Opened<LogFile> parts = LogFile::open({.path = folder.file("parts.log"), .part_bytes = 4}, at(0));
  ASSERT_FALSE(parts->write("aaa\nbbb\n", at(0)));
  for (int i = 0; i < 10'000 && syncs < 1; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(syncs, 1);
}

}  // namespace
}  // namespace fencepost::host
