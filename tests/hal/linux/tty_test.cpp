#include "hal/linux/tty.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <fstream>
#include <vector>

#include "hal/linux/clock.hpp"
#include "hal/linux/wait.hpp"
#include "tests/folder.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/text.hpp"

namespace fencepost::linux {
namespace {

using base::Error;
using base::milliseconds;
using base::Time;
using test::holds;
using test::octets;
using testing::AssertionResult;

bool wake(const Tty& tty) {
  const MonotonicClock clock;
  WaitSet set;
  set.add_readable(tty.descriptor());
  return set.wait_until(clock, Time{} + milliseconds(1000));
}

std::string read_all(Tty& tty) {
  std::array<std::uint8_t, 4096> buffer{};
  std::string text;
  while (const auto count = tty.read(buffer)) text.append(buffer.begin(), buffer.begin() + static_cast<long>(*count));
  return text;
}

class TtyTest : public testing::Test {
 protected:
  test::Folder folder;
  std::string path = folder.file("ttyRobot");
  FarEnd far{path};
};

TEST_F(TtyTest, CarriesEveryByteBothWays) {
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  std::string every(256, '\0');
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<char>(i);  // ^C, ^S, ^D, CR and NL among them
  far.say(every);
  ASSERT_TRUE(wake(*tty));
  EXPECT_EQ(read_all(*tty), every);
  EXPECT_EQ(tty->write(octets(every)).value(), every.size());
  EXPECT_EQ(far.heard(), every);
}

TEST_F(TtyTest, KeepsWhatCameBeforeItWasOpened) {
  far.say("early\n");
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  ASSERT_TRUE(wake(*tty));
  EXPECT_EQ(read_all(*tty), "early\n");
}

TEST_F(TtyTest, AnswersNotReadyOnAnEmptyLine) {
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(tty->read(buffer).error(), Error::kNotReady);
  EXPECT_EQ(tty->read({}).value(), 0U);
  EXPECT_EQ(tty->write({}).value(), 0U);
  EXPECT_TRUE(tty->connected());
}

TEST_F(TtyTest, ReadsInPieces) {
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  far.say("abcde");
  ASSERT_TRUE(wake(*tty));
  std::array<std::uint8_t, 3> buffer{};
  EXPECT_EQ(tty->read(buffer).value(), 3U);
  EXPECT_EQ(buffer[2], 'c');
  EXPECT_EQ(tty->read(buffer).value(), 2U);
  EXPECT_EQ(buffer[0], 'd');
}

TEST_F(TtyTest, WritesUntilFullAndNeverWaits) {
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  const std::vector<std::uint8_t> chunk(1000, 'x');
  std::size_t taken = 0;
  base::Result<std::size_t> count = tty->write(chunk);
  for (; count && taken < 10'000'000; count = tty->write(chunk)) taken += *count;
  ASSERT_FALSE(count) << "ten megabytes fitted";
  EXPECT_EQ(count.error(), Error::kFull);
  std::size_t heard = 0;
  while (heard < taken) {
    const std::size_t more = far.heard().size();
    ASSERT_GT(more, 0U) << heard << " of " << taken;
    heard += more;
  }
  EXPECT_EQ(heard, taken);
  EXPECT_TRUE(tty->write(chunk).ok());
}

TEST_F(TtyTest, SetsAnyBaudAndRawLines) {
  for (const std::uint32_t baud : {19'200U, 115'200U, 250'000U, 123'457U}) {
    Opened<Tty> tty = Tty::open({path, baud});
    ASSERT_TRUE(tty) << tty.problem();
    termios2 line{};
    ASSERT_EQ(::ioctl(tty->descriptor(), TCGETS2, &line), 0);
    EXPECT_EQ(line.c_ospeed, baud);
    EXPECT_EQ(line.c_ispeed, baud);
    EXPECT_EQ(line.c_cflag & (CSIZE | PARENB | CSTOPB | CRTSCTS), static_cast<tcflag_t>(CS8));
    EXPECT_EQ(line.c_lflag & (ICANON | ECHO | ISIG), 0U);
    EXPECT_EQ(line.c_iflag & (ICRNL | IXON), 0U);
    EXPECT_EQ(line.c_oflag & OPOST, 0U);
  }
}

TEST_F(TtyTest, IsForOneProgramAlone) {
  {
    Opened<Tty> first = Tty::open({path});
    ASSERT_TRUE(first) << first.problem();
    int exclusive = 0;
    ASSERT_EQ(::ioctl(first->descriptor(), TIOCGEXCL, &exclusive), 0);
    EXPECT_EQ(exclusive, 1);
    Opened<Tty> second = Tty::open({path});
    ASSERT_FALSE(second);
    EXPECT_TRUE(holds(second.problem(), path));
    EXPECT_TRUE(holds(second.problem(), "another program has it"));
  }
  Opened<Tty> third = Tty::open({path});
  EXPECT_TRUE(third) << third.problem();
}

TEST_F(TtyTest, LetsOthersInOnceClosed) {
  { Opened<Tty> first = Tty::open({path}); }
  const Descriptor other(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  ASSERT_TRUE(other.open());
  int exclusive = 1;
  ASSERT_EQ(::ioctl(other.get(), TIOCGEXCL, &exclusive), 0);
  EXPECT_EQ(exclusive, 0);
}

TEST_F(TtyTest, TellsOfAnUnplugOnReading) {
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  far.unplug();
  EXPECT_TRUE(wake(*tty));
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(tty->read(buffer).error(), Error::kGone);
  EXPECT_EQ(tty->read(buffer).error(), Error::kGone);
  EXPECT_EQ(tty->write(octets("x")).error(), Error::kGone);
  EXPECT_FALSE(tty->connected());
  EXPECT_EQ(tty->descriptor(), -1);
}

TEST_F(TtyTest, TellsOfAnUnplugOnWriting) {
  Opened<Tty> tty = Tty::open({path});
  ASSERT_TRUE(tty) << tty.problem();
  far.unplug();
  EXPECT_EQ(tty->write(octets("x")).error(), Error::kGone);
  EXPECT_FALSE(tty->connected());
}

TEST_F(TtyTest, ComesBackWithItsPathAndLooksForItFourTimesASecond) {
  Opened<Tty> tty = Tty::open({path, 57'600});
  ASSERT_TRUE(tty) << tty.problem();
  far.unplug();
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(tty->read(buffer).error(), Error::kGone);

  const Time start = Time{} + milliseconds(5000);
  tty->tend(start);
  EXPECT_FALSE(tty->connected());
  EXPECT_TRUE(holds(tty->problem(), path));
  far.plug();
  tty->tend(start + milliseconds(249));
  EXPECT_FALSE(tty->connected()) << "looked for it too often";
  tty->tend(start + milliseconds(250));
  ASSERT_TRUE(tty->connected()) << tty->problem();
  EXPECT_EQ(tty->problem(), "");

  termios2 line{};
  ASSERT_EQ(::ioctl(tty->descriptor(), TCGETS2, &line), 0);
  EXPECT_EQ(line.c_ospeed, 57'600U);
  far.say("back");
  ASSERT_TRUE(wake(*tty));
  EXPECT_EQ(read_all(*tty), "back");
}

TEST_F(TtyTest, SurvivesBeingMoved) {
  Opened<Tty> opened = Tty::open({path});
  ASSERT_TRUE(opened) << opened.problem();
  Tty tty = std::move(*opened);
  EXPECT_FALSE(opened->connected());
  far.say("here");
  ASSERT_TRUE(wake(tty));
  EXPECT_EQ(read_all(tty), "here");
}

TEST(TtyProblem, NamesThePathAndWhatToTry) {
  const test::Folder folder;
  const std::string missing = folder.file("ttyUSB7");
  Opened<Tty> tty = Tty::open({missing});
  ASSERT_FALSE(tty);
  EXPECT_TRUE(holds(tty.problem(), "cannot open the serial port " + missing));
  EXPECT_TRUE(holds(tty.problem(), "No such file"));
  EXPECT_TRUE(holds(tty.problem(), "plug it in"));
}

TEST(TtyProblem, TellsAFileFromAPort) {
  const test::Folder folder;
  const std::string file = folder.file("a.log");
  std::ofstream(file) << "text";
  for (const std::string& path : {file, folder.file("")}) {
    Opened<Tty> tty = Tty::open({path});
    ASSERT_FALSE(tty) << path;
    EXPECT_TRUE(holds(tty.problem(), path));
    EXPECT_TRUE(holds(tty.problem(), "name a device"));
  }
}

}  // namespace
}  // namespace fencepost::linux
