#include "host/live/console_port.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "host/live/open_port.hpp"
#include "tests/folder.hpp"
#include "tests/text.hpp"

namespace fencepost::host {
namespace {

using base::Error;
using base::milliseconds;
using base::Time;
using test::octets;

TEST(ConsoleSpec, ReadsEveryPlace) {
  EXPECT_EQ(parse_console("-")->kind, ConsoleSpec::Kind::kTerminal);
  EXPECT_EQ(parse_console("pty")->kind, ConsoleSpec::Kind::kPty);
  const auto tcp = parse_console("tcp:desk:4000");
  EXPECT_EQ(tcp->place.kind, PlaceKind::kTcp);
  EXPECT_EQ(tcp->place.port, 4000);
  const auto tty = parse_console("/dev/ttyGS0,baud=9600");
  EXPECT_EQ(tty->place.kind, PlaceKind::kTty);
  EXPECT_EQ(tty->place.name, "/dev/ttyGS0");
  EXPECT_EQ(tty->baud, 9'600U);
  EXPECT_EQ(parse_console("/dev/ttyGS0")->baud, 115'200U);
  const auto here = parse_console("tcp-listen:4000");
  EXPECT_EQ(here->kind, ConsoleSpec::Kind::kListen);
  EXPECT_EQ(here->place.name, "127.0.0.1") << "not the whole network, unless that was said";
  EXPECT_EQ(here->place.port, 4000);
  EXPECT_EQ(parse_console("tcp-listen:0.0.0.0:4000")->place.name, "0.0.0.0");
  EXPECT_EQ(parse_console("tcp-listen:[::1]:4000")->place.name, "::1");
  EXPECT_EQ(parse_console("tcp-listen:0")->place.port, 0) << "any free one; the run says which";
  EXPECT_FALSE(parse_console("tcp:desk:0").ok());
}

TEST(ConsoleSpec, SaysWhatIsAllowed) {
  for (const char* text : {"", "COM3", "tcp:desk", "ptty", "tcp-listen:", "tcp-listen:x:", "tcp-listen:70000",
                           "/dev/ttyS0,baud=", "/dev/ttyS0,baud=9e3", "/dev/ttyS0,x=1"}) {
    const auto spec = parse_console(text);
    ASSERT_FALSE(spec.ok()) << text;
    EXPECT_NE(spec.error().find("allowed: - (this terminal), pty, tcp:HOST:PORT"), std::string::npos) << spec.error();
  }
}

/// Takes as many bytes as the test allows.
class FakePort final : public ConsolePort {
 public:
  base::Result<std::size_t> read(std::span<std::uint8_t> /*in*/) override { return Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override {
    if (!there) return Error::kGone;
    const std::size_t count = std::min(out.size(), room);
    if (count == 0) return Error::kFull;
    said.append(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count));
    room -= count;
    return count;
  }
  void tend(Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return there; }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }

  bool there = true;
  std::size_t room = 0;
  std::string said;
};

class PatientConsoleTest : public testing::Test {
 protected:
  /// Writes it all as the loop does: what was not taken comes again.
  std::size_t write(std::string_view text) {
    const auto taken = console.write(octets(text));
    return taken ? *taken : 0;
  }
  FakePort port;
  PatientConsole console{port, true};
};

TEST_F(PatientConsoleTest, WaitsForASecondThenThrowsAway) {
  EXPECT_EQ(console.write(octets("one\n")).error(), Error::kFull);
  console.tend(Time{} + milliseconds(999));
  EXPECT_EQ(console.write(octets("one\n")).error(), Error::kFull);
  console.tend(Time{} + milliseconds(1000));
  EXPECT_EQ(write("one\n"), 4U);
  EXPECT_EQ(write("two\n"), 4U);
  EXPECT_EQ(console.lost(), 8U);
  EXPECT_EQ(port.said, "");
  port.room = 100;
  EXPECT_EQ(write("three\n"), 6U);
  EXPECT_EQ(port.said, "three\n");
}

TEST_F(PatientConsoleTest, GoesOnWithAWholeLine) {
  port.room = 5;
  EXPECT_EQ(write("first line\n"), 5U);
  EXPECT_EQ(write(" line\n"), 0U);
  console.tend(Time{} + milliseconds(1000));
  EXPECT_EQ(write(" line\nsecond li"), 15U);
  port.room = 100;
  EXPECT_EQ(write("ne\nthird\n"), 9U);
  EXPECT_EQ(port.said, "first\r\nthird\n");
  EXPECT_EQ(console.lost(), 15U + 3U);
}

TEST_F(PatientConsoleTest, DoesNotWaitForALineThatIsGone) {
  port.there = false;
  EXPECT_EQ(write("one\n"), 4U);
  port.there = true;
  port.room = 100;
  EXPECT_EQ(write("two\n"), 4U);
  EXPECT_EQ(port.said, "two\n");
}

TEST_F(PatientConsoleTest, AConsoleThatIsTheLogLosesNothingHoweverLongItTakes) {
  PatientConsole log(port, false);
  EXPECT_EQ(log.write(octets("one\n")).error(), Error::kFull);
  log.tend(Time{} + milliseconds(100'000));
  EXPECT_EQ(log.write(octets("one\n")).error(), Error::kFull);
  port.room = 100;
  EXPECT_EQ(log.write(octets("one\n")).value(), 4U);
  EXPECT_EQ(port.said, "one\n");
}

TEST_F(PatientConsoleTest, ASlowConsoleLosesNothing) {
  std::string text = "a line that takes its time\n";
  for (int i = 0; i < 200 && !text.empty(); ++i) {
    console.tend(Time{} + milliseconds(400 * i));
    port.room = i % 2 == 0 ? 0 : 1;
    text.erase(0, write(text));
  }
  EXPECT_EQ(port.said, "a line that takes its time\n");
  EXPECT_EQ(console.lost(), 0U);
}

TEST(TerminalConsole, EndsWithItsInputAndKnowsAClosedPipe) {
  int input[2];
  int output[2];
  ASSERT_EQ(::pipe(input), 0);
  ASSERT_EQ(::pipe(output), 0);
  TerminalConsole console(input[0], output[1]);
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(console.read(in).error(), Error::kNotReady);
  ASSERT_EQ(::write(input[1], "help\n", 5), 5);
  EXPECT_EQ(console.read(in).value(), 5U);
  EXPECT_FALSE(console.ended());
  ::close(input[1]);
  EXPECT_EQ(console.read(in).error(), Error::kNotReady);
  EXPECT_TRUE(console.ended());
  EXPECT_EQ(console.descriptor(), -1) << "an ended input wakes nobody";

  EXPECT_EQ(console.write(octets("text\n")).value(), 5U);
  EXPECT_FALSE(console.lost());
  EXPECT_TRUE(console.connected());
  ::close(output[0]);
  ::signal(SIGPIPE, SIG_IGN);
  EXPECT_EQ(console.write(octets("text\n")).error(), Error::kGone);
  EXPECT_EQ(console.lost(), "nobody reads standard output any more");
  EXPECT_FALSE(console.connected()) << "what follows is thrown away, and counted";
  ::close(input[0]);
  ::close(output[1]);
}

TEST(TerminalConsole, AFullPipeIsNotWaitedFor) {
  int output[2];
  ASSERT_EQ(::pipe(output), 0);
  const int closed = ::dup(output[0]);
  ::close(closed);
  TerminalConsole console(closed, output[1]);
  const std::string much(4096, 'x');
  base::Result<std::size_t> taken = Error::kNotReady;
  for (int i = 0; i < 1000; ++i) {
    taken = console.write(octets(much));
    if (!taken) break;
  }
  EXPECT_EQ(taken.error(), Error::kFull);
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(console.read(in).error(), Error::kNotReady) << "no input at all";
  EXPECT_TRUE(console.ended());
  ::close(output[0]);
  ::close(output[1]);
}

TEST(TerminalConsole, AFullDeviceIsSaid) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  TerminalConsole console(-1, full);
  EXPECT_EQ(console.write(octets("text\n")).error(), Error::kGone);
  ASSERT_TRUE(console.lost());
  EXPECT_NE(console.lost()->find("cannot write standard output: No space left on device"), std::string::npos);
  ::close(full);
}

// The disk of a file may take its time; the loop does not.
TEST(TerminalConsole, AFileIsWrittenByAThread) {
  const test::Folder folder;
  const std::string path = folder.file("out");
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  TerminalConsole console(-1, file);
  EXPECT_EQ(console.write(octets("one\ntwo\n")).value(), 8U);
  EXPECT_EQ(console.finish(std::chrono::milliseconds(60'000)), 0U);
  EXPECT_FALSE(console.lost());
  ::close(file);
  std::string written(100, ' ');
  const int again = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  written.resize(static_cast<std::size_t>(::read(again, written.data(), written.size())));
  ::close(again);
  EXPECT_EQ(written, "one\ntwo\n");
}

TEST(TerminalConsole, AFileThatCannotBeWrittenIsSaidAndCounted) {
  const test::Folder folder;
  const std::string path = folder.file("out");
  const int file = ::open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0600);
  TerminalConsole console(-1, file);
  EXPECT_EQ(console.write(octets("one\ntwo\n")).value(), 8U);
  EXPECT_EQ(console.finish(std::chrono::milliseconds(60'000)), 8U);
  ASSERT_TRUE(console.lost());
  EXPECT_EQ(console.write(octets("three\n")).error(), Error::kGone);
  ::close(file);
}

// A name in a robot file, or what was typed and is quoted, must not reprogram the terminal.
TEST(TerminalConsole, ATerminalGetsNoControlSequences) {
  const auto pty = PtyConsole::open();
  const int terminal = ::open(pty->path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_TRUE(::isatty(terminal));
  TerminalConsole console(-1, terminal);
  EXPECT_EQ(console.write(octets("a\tb\x1b[2J\xE2\x82")).value(), 9U);
  EXPECT_EQ(console
                .write(octets("\xAC \xC2\x9B"
                              "1m\x9B\n"))
                .value(),
            8U)
      << "the euro sign came in two portions";
  std::array<std::uint8_t, 64> in{};
  std::string shown;
  while (shown.size() < 17) {
    const auto count = pty->read(in);
    if (count) shown.append(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(*count));
  }
  EXPECT_EQ(shown, "a\tb?[2J\xE2\x82\xAC \xC2?1m?\n");
  ::close(terminal);
}

}  // namespace
}  // namespace fencepost::host
