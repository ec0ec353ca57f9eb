// A command at each change of level, with real processes.
#include "host/live/alert_command.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/folder.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::host {
namespace {

using record::AlertLevel;
using Ms = std::chrono::milliseconds;

AlertNow alert_at(AlertLevel level) {
  AlertNow alert;
  alert.beat = {base::Time::nearest(12.5), level, sensor::LinkState::kOk, sensor::LinkState::kEmpty};
  return alert;
}

class AlertCommandTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder.file(name); }
  /// Its first message within a generous time.
  static std::string said_by(AlertCommand& command) {
    for (int i = 0; i < 5'000; ++i) {
      const std::vector<std::string> messages = command.messages();
      if (!messages.empty()) return messages.front();
      std::this_thread::sleep_for(Ms(2));
    }
    return "nothing";
  }
  void await_file(const std::string& name) const {
    for (int i = 0; i < 5'000 && !std::filesystem::exists(path(name)); ++i) std::this_thread::sleep_for(Ms(2));
    ASSERT_TRUE(std::filesystem::exists(path(name)));
  }

  test::Folder folder;
};

TEST_F(AlertCommandTest, GetsTheStateAsArgumentAndEnvironment) {
  AlertNow alert = alert_at(AlertLevel::kStop);
  alert.of.emplace();
  alert.of->id = 3;
  alert.of->distance = base::Metres::nearest(0.27);
  alert.of->bearing = base::Radians::nearest(-0.05);
  alert.of->ttc = base::Duration::nearest(0.9);
  alert.colour = "red; rm -rf x";  // a name is no part of the line
  {
    AlertCommand command("echo \"$1\" > '" + path("seen") + "'; env | grep ^FENCEPOST_ | sort >> '" + path("seen") +
                         "'");
    command.show(alert, {});
    command.show(alert, {});
  }
  EXPECT_EQ(test::contents(path("seen")),
            "stop\nFENCEPOST_BEARING=-0.0500\nFENCEPOST_CAMERA=ok\nFENCEPOST_COLOUR=red; rm -rf x\n"
            "FENCEPOST_DISTANCE=0.2700\nFENCEPOST_ID=3\nFENCEPOST_LEVEL=stop\nFENCEPOST_ODOMETRY=empty\n"
            "FENCEPOST_TIME=12.5000\nFENCEPOST_TTC=0.9000\n");
}

TEST_F(AlertCommandTest, WhatIsNotKnownIsEmpty) {
  for (const std::string& entry : environment_of(alert_at(AlertLevel::kClear))) {
    const bool told = entry.starts_with("FENCEPOST_LEVEL") || entry.starts_with("FENCEPOST_CAMERA") ||
                      entry.starts_with("FENCEPOST_ODOMETRY") || entry.starts_with("FENCEPOST_TIME");
    EXPECT_NE(entry.ends_with('='), told) << entry;
  }
}

TEST_F(AlertCommandTest, RunsAtEachChangeAndOnlyThen) {
  AlertCommand command("echo $1 >> '" + path("seen") + "'; touch '" + path("") + "'$1");
  for (const AlertLevel level : {AlertLevel::kBlind, AlertLevel::kClear, AlertLevel::kWarn}) {
    for (int i = 0; i < 3; ++i) command.show(alert_at(level), {});
    await_file(std::string(name(level)));
  }
  command.end({});
  EXPECT_EQ(test::contents(path("seen")), "blind\nclear\nwarn\nblind\n") << "the end of the run is a change, too";
  EXPECT_TRUE(command.messages().empty());
}

TEST_F(AlertCommandTest, TheEndOfARunThatStandsIsNoChange) {
  AlertCommand command("echo $1 >> '" + path("seen") + "'");
  command.show(alert_at(AlertLevel::kStop), {});
  command.end({});
  EXPECT_EQ(test::contents(path("seen")), "stop\n");
}

// One command runs at a time; a newer alert replaces the one that waits.
TEST_F(AlertCommandTest, TheNewestChangeIsNotLostBehindASlowOne) {
  const auto begun = std::chrono::steady_clock::now();
  {
    AlertCommand command("echo begin $1 >> '" + path("seen") + "'; touch '" + path("") +
                             "'$1; sleep 0.2; echo end $1 >> '" + path("seen") + "'",
                         Ms(3'600'000));
    command.show(alert_at(AlertLevel::kNotice), {});
    await_file("notice");
    const auto before = std::chrono::steady_clock::now();
    command.show(alert_at(AlertLevel::kWarn), {});
    command.show(alert_at(AlertLevel::kStop), {});
    EXPECT_LT(std::chrono::steady_clock::now() - before, Ms(150)) << "the loop does not wait";
  }
  EXPECT_EQ(test::contents(path("seen")), "begin notice\nend notice\nbegin stop\nend stop\n");
  EXPECT_GE(std::chrono::steady_clock::now() - begun, Ms(400));
}

TEST_F(AlertCommandTest, OneThatHangsIsKilledWithAllThatItStarted) {
  AlertCommand command(
      "if [ $1 = warn ]; then (sleep 3; touch '" + path("late") + "') & sleep 1000; fi; touch '" + path("") + "'$1",
      Ms(200));
  command.show(alert_at(AlertLevel::kWarn), {});
  command.show(alert_at(AlertLevel::kWarn), {});
  EXPECT_EQ(
      said_by(command),
      "--on-alert: the command for level warn still ran after 0.2 s and was killed; let it begin long work with '&'");
  command.show(alert_at(AlertLevel::kStop), {});
  await_file("stop");
  EXPECT_FALSE(std::filesystem::exists(path("warn")));
  std::this_thread::sleep_for(Ms(3'500));
  EXPECT_FALSE(std::filesystem::exists(path("late"))) << "its children went with it";
}

std::vector<pid_t> asked;  // processes that a stand-in for kill(2) was to kill

int fail(int error) {
  errno = error;
  return -1;
}
int refuse(pid_t pid, int /*signal*/) {
  if (pid > 0) asked.push_back(pid);
  return fail(EPERM);
}
int refuse_groups(pid_t pid, int signal) { return pid < 0 ? fail(EPERM) : ::kill(pid, signal); }
int find_no_group(pid_t pid, int signal) {
  if (pid < 0) return fail(ESRCH);
  asked.push_back(pid);
  return ::kill(pid, signal);
}

// It left its group by setpgid(2).
TEST_F(AlertCommandTest, OneThatJoinedAnotherGroupIsKilled) {
  asked.clear();
  AlertCommand command("exec sleep 1000", Ms(200), find_no_group);
  command.show(alert_at(AlertLevel::kWarn), {});
  EXPECT_NE(said_by(command).find("and was killed"), std::string::npos);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_NE(::kill(asked[0], 0), 0) << "it still lives";
}

// As one that sudo made another user's.
TEST_F(AlertCommandTest, OneThatCannotBeKilledHoldsNeitherTheNextLevelNorTheEnd) {
  asked.clear();
  AlertCommand command("if [ $1 = blind ]; then exec sleep 1000; fi; touch '" + path("") + "'$1", Ms(1'000), refuse);
  command.show(alert_at(AlertLevel::kBlind), {});
  EXPECT_EQ(said_by(command),
            "--on-alert: the command for level blind still ran after 1.0 s and cannot be killed (Operation not "
            "permitted); commands of later levels run beside it; a program under sudo needs its own time limit");
  command.show(alert_at(AlertLevel::kWarn), {});
  await_file("warn");
  command.end({});
  EXPECT_EQ(asked.size(), 2U) << "the end runs the command and does not wait for it";
  for (const pid_t pid : asked) EXPECT_EQ(::kill(pid, SIGKILL), 0) << "it does not live any more";
}

// The shell ended, what it started did not.
TEST_F(AlertCommandTest, SaysThatPartOfItCannotBeKilled) {
  AlertCommand command("sleep 3 & wait", Ms(200), refuse_groups);
  command.show(alert_at(AlertLevel::kWarn), {});
  EXPECT_NE(said_by(command).find("cannot be killed (Operation not permitted)"), std::string::npos);
}

TEST_F(AlertCommandTest, SaysOnceWhatIsWrongUntilSomethingElseIs) {
  AlertCommand command("case $1 in notice) exit 3;; warn) exit 3;; stop) kill -9 $$;; esac");
  command.show(alert_at(AlertLevel::kNotice), {});
  EXPECT_EQ(said_by(command), "--on-alert: the command for level notice ended with exit code 3");
  command.show(alert_at(AlertLevel::kWarn), {});
  command.show(alert_at(AlertLevel::kWarn), {});
  std::this_thread::sleep_for(Ms(200));
  command.show(alert_at(AlertLevel::kStop), {});
  EXPECT_EQ(said_by(command), "--on-alert: the command for level stop was ended by signal 9");
  AlertCommand missing(path("no-such-program"));
  missing.show(alert_at(AlertLevel::kClear), {});
  EXPECT_NE(said_by(missing).find("the shell did not find it"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
