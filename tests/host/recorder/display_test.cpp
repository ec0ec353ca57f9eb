#include "host/recorder/display.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>

#include "hal/linux/descriptor.hpp"

namespace fencepost::host {
namespace {

using linux::Descriptor;

/// Standard output and error are pipes that the test reads.
class DisplayTest : public testing::Test {
 protected:
  DisplayTest() : out_(redirect(STDOUT_FILENO, saved_out_)), err_(redirect(STDERR_FILENO, saved_err_)) {}
  ~DisplayTest() override { restore(); }

  void restore() {
    if (!saved_out_.open()) return;
    ::dup2(saved_out_.get(), STDOUT_FILENO);
    ::dup2(saved_err_.get(), STDERR_FILENO);
    saved_out_.close();
    saved_err_.close();
  }
  static std::string heard(const Descriptor& pipe) {
    std::string text;
    std::array<char, 65536> buffer{};
    for (ssize_t count = 0; (count = ::read(pipe.get(), buffer.data(), buffer.size())) > 0;) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return text;
  }
  void close_reader() { out_.close(); }

  Descriptor saved_out_;
  Descriptor saved_err_;
  Descriptor out_;
  Descriptor err_;

 private:
  static Descriptor redirect(int fd, Descriptor& saved) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    saved = Descriptor(::fcntl(fd, F_DUPFD_CLOEXEC, 3));
    ::dup2(ends[1], fd);
    ::close(ends[1]);
    return Descriptor(ends[0]);
  }
};

TEST_F(DisplayTest, ShowsWholeLinesAsTheyCame) {
  Display display({});
  display.take("one\r\ntw");
  display.flush();
  EXPECT_EQ(heard(out_), "one\r\n");
  display.take("o\xff\n\n");
  display.flush();
  EXPECT_EQ(heard(out_), "two\xff\n\n");
  display.take("no end");
  display.finish(0);
  EXPECT_EQ(heard(out_), "no end");
}

TEST_F(DisplayTest, ATerminalIsShownNoEscapeSequences) {
  Display display({.out_is_terminal = true});
  display.take("a\tb\x1b[2Jc\x07\x7f\r\n");
  display.flush();
  EXPECT_EQ(heard(out_), "a\tb?[2Jc??\n");
}

// The words of a robot: its FPLNK names a device and says why.
TEST_F(DisplayTest, NeitherDoMessagesAndTheStatusLine) {
  Display display({.out_is_terminal = true, .status = true});
  display.set_status(
      "camera \x1b]0;mine\x07 absent\n\xC2\x9B"
      "2J");
  EXPECT_EQ(heard(err_), "camera ?]0;mine? absent???2J");
  display.say(
      "links at the end: \x9B"
      "2J\nforged");
  EXPECT_EQ(heard(err_), "\r\x1b[Klinks at the end: ?2J?forged\ncamera ?]0;mine? absent???2J");
}

TEST_F(DisplayTest, ASlowReaderLosesWholeLinesAndHoldsUpNothing) {
  Display display({});
  const std::string line = std::string(999, 'x') + "\n";
  constexpr std::size_t kLines = 3000;
  for (std::size_t i = 0; i < kLines; ++i) {
    display.take(line);
    display.flush();
  }
  EXPECT_EQ(display.descriptor(), STDOUT_FILENO);
  std::string shown;
  for (std::string part; display.descriptor() >= 0; display.flush()) shown += heard(out_);
  shown += heard(out_);
  EXPECT_GT(display.lines_not_shown(), 0U);
  EXPECT_EQ(shown.size() % line.size(), 0U);
  EXPECT_EQ(shown.size() / line.size() + display.lines_not_shown(), kLines);
}

TEST_F(DisplayTest, WhatIsNeverReadIsCountedAtTheEnd) {
  Display display({});
  for (int i = 0; i < 200; ++i) display.take(std::string(999, 'x') + "\n");
  display.finish(1);
  EXPECT_EQ(heard(out_).size() / 1000 + display.lines_not_shown(), 200U);
  EXPECT_GT(display.lines_not_shown(), 0U);
}

TEST_F(DisplayTest, AReaderThatGoesIsToldOnce) {
  ::signal(SIGPIPE, SIG_IGN);
  Display display({});
  close_reader();
  for (int i = 0; i < 3; ++i) {
    display.take("line\n");
    display.flush();
  }
  EXPECT_EQ(display.descriptor(), -1);
  EXPECT_EQ(heard(err_), "standard output is closed (its reader has gone); the recording goes on\n");
}

TEST_F(DisplayTest, MessagesAndLinesDoNotMixWithTheStatusLine) {
  Display display({.out_is_terminal = true, .status = true});
  display.set_status("0:01");
  display.set_status("0:01");
  EXPECT_EQ(heard(err_), "0:01");
  display.say("message");
  EXPECT_EQ(heard(err_), "\r\x1b[Kmessage\n0:01");
  display.take("line\n");
  display.flush();
  EXPECT_EQ(heard(err_), "\r\x1b[K0:01");
  display.finish(0);
  EXPECT_EQ(heard(err_), "\r\x1b[K");
}

TEST_F(DisplayTest, QuietShowsNoLines) {
  Display display({.lines = false});
  display.take("line\n");
  display.finish(0);
  EXPECT_EQ(heard(out_), "");
}

}  // namespace
}  // namespace fencepost::host
