#include "host/cli/progress.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host/cli/terminal.hpp"

namespace fencepost::host::cli {
namespace {

struct Screen {
  double now = 100;
  std::vector<std::string> written;

  Progress progress(const std::string& what) {
    return {what, [this] { return std::chrono::duration<double>(now); },
            [this](std::string_view text) { written.emplace_back(text); }};
  }
};

const std::string kErase = "\r\x1b[K";

TEST(Progress, SaysNothingOfWhatIsSoonOver) {
  Screen screen;
  {
    Progress progress = screen.progress("replaying");
    progress.at(1, 2);
    screen.now += 0.99;
    progress.at(2, 2);
  }
  EXPECT_TRUE(screen.written.empty());
}

TEST(Progress, TellsTheTimeLeftByTheWorkDone) {
  Screen screen;
  Progress progress = screen.progress("evaluating");
  screen.now += 30;
  progress.at(25, 100, "1 of 4 logs");
  EXPECT_EQ(screen.written, std::vector{kErase + "evaluating: 1 of 4 logs, 25 %, 1 min 30 s left"});
  progress.at(26, 100);
  EXPECT_EQ(screen.written.size(), 1U) << "ten times a second are enough";
  screen.now += 10;
  progress.at(50, 100, "2 of 4 logs");
  EXPECT_EQ(screen.written.back(), kErase + "evaluating: 2 of 4 logs, 50 %, 40 s left");
  screen.now += 1;
  progress.at(0, 0, "");
  EXPECT_EQ(screen.written.back(), kErase + "evaluating: 41 s");
}

// `calibrate 2> words.txt` of an hour: nobody takes it for one that hangs.
TEST(Progress, InAFileLongWorkIsALineAMinute) {
  Screen screen;
  {
    Progress progress{"smoothing", [&screen] { return std::chrono::duration<double>(screen.now); },
                      [&screen](std::string_view text) { screen.written.emplace_back(text); }, true};
    screen.now += 9.9;
    progress.at(0.05, 1);
    EXPECT_TRUE(screen.written.empty());
    screen.now += 0.1;
    progress.at(0.1, 1);
    EXPECT_EQ(screen.written, std::vector<std::string>{"smoothing: 10 %, 1 min 30 s left\n"});
    screen.now += 59;
    progress.at(0.5, 1);
    EXPECT_EQ(screen.written.size(), 1U);
    screen.now += 1;
    progress.at(0.5, 1);
    EXPECT_EQ(screen.written.back(), "smoothing: 50 %, 1 min 10 s left\n");
  }
  EXPECT_EQ(screen.written.size(), 2U) << "nothing is taken away";
}

TEST(Progress, OfTooLittleWorkNoTimeIsTold) {
  Screen screen;
  Progress progress = screen.progress("replaying");
  screen.now += 2;
  progress.at(1, 1000);
  EXPECT_EQ(screen.written.back(), kErase + "replaying: 0 %");
  screen.now += 1;
  progress.at(3, 0, "a\x1b[2Jb");
  EXPECT_EQ(screen.written.back(), kErase + "replaying: a?[2Jb, 3 s") << "nothing in it moves the cursor";
}

TEST(Progress, IsGoneAtItsEndAndWhileAMessageIsSaid) {
  Screen screen;
  {
    Progress progress = screen.progress("replaying");
    screen.now += 5;
    progress.at(1, 2);
    ::testing::internal::CaptureStderr();
    say("a message");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "a message\n");
    EXPECT_EQ(screen.written.back(), kErase);
    screen.now += 5;
    progress.at(1, 2);
    EXPECT_EQ(screen.written.back(), kErase + "replaying: 50 %, 10 s left") << "it comes again";
  }
  EXPECT_EQ(screen.written.back(), kErase);
  EXPECT_EQ(screen.written.size(), 4U);
}

TEST(Progress, WithoutATerminalIsSilent) {
  ::testing::internal::CaptureStderr();
  {
    double now = 0;
    Progress progress("replaying", [&] { return std::chrono::duration<double>(now); }, {});
    now = 100;
    progress.at(1, 2);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, TimesAreAsExactAsTheyCanBe) {
  EXPECT_EQ(time_words(0.2), "0 s");
  EXPECT_EQ(time_words(59.4), "59 s");
  EXPECT_EQ(time_words(59.6), "1 min");
  EXPECT_EQ(time_words(200), "3 min 20 s");
  EXPECT_EQ(time_words(594), "9 min 50 s");
  EXPECT_EQ(time_words(596), "10 min");
  EXPECT_EQ(time_words(3569), "59 min");
  EXPECT_EQ(time_words(3600), "1 h");
  EXPECT_EQ(time_words(3900), "1 h 5 min");
}

}  // namespace
}  // namespace fencepost::host::cli
