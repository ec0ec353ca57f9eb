// A log beside the console: the same bytes as a console in mode log would write, whatever the console shows.
#include "firmware/loop/journal.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::Mode;

using Journaled = loop::Journaled<config::Micro, 4096>;

static_assert(sizeof(loop::Memory<Journaled>) > sizeof(loop::Memory<config::Micro>) + Journaled::kJournalBytes - 1);

template <class Desk>
std::string take_journal(Desk& desk) {
  const auto waiting = desk.memory().journal.waiting();
  std::string text(waiting.begin(), waiting.end());
  desk.memory().journal.taken(waiting.size());
  return text;
}

// The journal of a run of 100 frames and 2 s.
std::string journal_in(Mode mode, std::string& said, std::uint64_t& digest) {
  Desk<Journaled> desk(mode, desk_approach(100));
  desk.memory().journal.start();
  std::string journal;
  for (int i = 0; i < 2100; ++i) {
    desk.turn();
    journal += take_journal(desk);
  }
  said = desk.link.take_said();
  digest = desk.memory().map.digest();
  return journal;
}

TEST(Journal, HoldsWhatAConsoleInModeLogWouldWrite) {
  Desk<> robot(Mode::kLog, desk_approach(100));
  robot.turn(2100);
  const std::string log = robot.link.take_said();
  ASSERT_NE(log.find("$FPHDR"), std::string::npos);
  ASSERT_NE(log.find("$FPALR"), std::string::npos);
  ASSERT_NE(log.find("$FPDIG"), std::string::npos);
  ASSERT_NE(log.find("$FPSTA"), std::string::npos);

  for (const Mode mode : {Mode::kText, Mode::kPlot, Mode::kQuiet, Mode::kLog}) {
    std::string said;
    std::uint64_t digest = 0;
    EXPECT_EQ(journal_in(mode, said, digest), log) << name(mode);
    EXPECT_EQ(digest, robot.memory().map.digest()) << name(mode);
    EXPECT_EQ(said.find('$') != std::string::npos, mode == Mode::kLog) << said;
    EXPECT_EQ(said.find("NOTICE") != std::string::npos, mode == Mode::kText) << said;
    EXPECT_EQ(said == log, mode == Mode::kLog);
  }
}

TEST(Journal, KeepsAlertsThatTheConsoleDoesNotWant) {
  Desk<Journaled> desk(Mode::kText, desk_approach(100));
  desk.memory().journal.start();
  desk.type_line("alerts off");
  std::string journal;
  for (int i = 0; i < 2100; ++i) {
    desk.turn();
    journal += take_journal(desk);
  }
  EXPECT_NE(journal.find("$FPALR"), std::string::npos);
  EXPECT_EQ(desk.link.take_said().find("NOTICE"), std::string::npos);
}

TEST(Journal, WithoutRoomNoInputIsUsed) {
  for (const Mode mode : {Mode::kText, Mode::kLog}) {
    Desk<Journaled> desk(mode, desk_approach(100));
    desk.memory().journal.start();
    desk.turn(2100);  // nobody takes anything
    const std::string journal = take_journal(desk);
    const auto used = [&](const std::string& log, std::string_view kind) {
      std::uint32_t count = 0;
      for (std::size_t at = log.find(kind); at != std::string::npos; at = log.find(kind, at + 1)) ++count;
      return count;
    };
    const console::Counters& counters = desk.memory().counters;
    EXPECT_EQ(counters.odometry, used(journal, "$FPODO"));
    EXPECT_EQ(counters.refused[static_cast<std::size_t>(console::Refusal::kQueue)], 100 - used(journal, "$FPFRM"));
    EXPECT_GT(counters.refused[static_cast<std::size_t>(console::Refusal::kQueue)], 0U);
    EXPECT_EQ(used(desk.link.take_said(), "$FPODO"), mode == Mode::kLog ? counters.odometry : 0) << "nor the console";
  }
}

// A replay reads frames and odometry itself.
TEST(Journal, WithoutInputsTheOthersAreTheSame) {
  Desk<Journaled> whole(Mode::kText, desk_approach(100));
  Desk<Journaled> others(Mode::kText, desk_approach(100));
  whole.memory().journal.start();
  others.memory().journal.start(false);
  std::string expected;
  std::string journal;
  for (int i = 0; i < 2100; ++i) {
    whole.turn();
    others.turn();
    std::istringstream lines(take_journal(whole));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("$FPFRM") && !line.starts_with("$FPODO")) expected += line + "\n";
    }
    journal += take_journal(others);
  }
  EXPECT_NE(journal.find("$FPALR"), std::string::npos);
  EXPECT_EQ(journal, expected);
  EXPECT_EQ(others.memory().map.digest(), whole.memory().map.digest());
  EXPECT_GT(others.memory().map.frames(), 50U);
}

TEST(Journal, StoppedTheLoopGoesOn) {
  Desk<Journaled> desk(Mode::kText, desk_approach(100));
  desk.memory().journal.start();
  desk.turn(1000);
  const std::uint32_t before = desk.memory().counters.odometry;
  desk.memory().journal.stop();
  desk.turn(1100);
  EXPECT_TRUE(take_journal(desk).empty());
  EXPECT_LT(before, 50U);
  EXPECT_EQ(desk.memory().counters.odometry, before + 50);
}

TEST(Journal, ConsoleModesMayChangeMeanwhile) {
  Desk<Journaled> desk(Mode::kText, desk_approach(100));
  desk.memory().journal.start();
  std::string journal;
  for (int i = 0; i < 2100; ++i) {
    if (i == 500) desk.link.type("mode log\r");
    if (i == 1500) desk.link.type("mode quiet\r");
    desk.turn();
    journal += take_journal(desk);
  }
  std::size_t frames = 0;
  for (std::size_t at = journal.find("$FPFRM"); at != std::string::npos; at = journal.find("$FPFRM", at + 1)) ++frames;
  EXPECT_EQ(frames, 100U);
  EXPECT_EQ(journal.find("$FPHDR", 1), std::string::npos) << "the run is still the same";
  EXPECT_EQ(desk.link.take_said().find("$FPHDR"), std::string::npos) << "the console's log does not hold all of it";
}

}  // namespace
}  // namespace fencepost::test
