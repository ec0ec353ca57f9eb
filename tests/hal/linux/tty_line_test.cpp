// Behaviour of serial lines' drivers that no pseudo-terminal has.
#include "hal/linux/tty_line.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <linux/serial.h>
#include <linux/tty_flags.h>

#include <cerrno>

#include "hal/linux/tty.hpp"
#include "tests/folder.hpp"
#include "tests/hal/linux/fake_ioctl.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/text.hpp"

namespace fencepost::linux {
namespace {

using test::FakeIoctl;
using test::holds;
using testing::AssertionResult;

class TtyLine : public testing::Test {
 protected:
  /// A line whose driver makes `actual` of each baud, and keeps `flags` of the request.
  auto makes(std::uint32_t actual, tcflag_t flags = CS8) {
    return [this, actual, flags](unsigned long request, void* argument) -> std::optional<int> {
      if (request == TCSETS2) told_ = *static_cast<const termios2*>(argument);
      if (request != TCGETS2) return request == TCSETS2 ? std::optional(0) : std::nullopt;
      auto& line = *static_cast<termios2*>(argument);
      line.c_ospeed = actual;
      line.c_cflag = flags;
      return 0;
    };
  }
  std::string problem() {
    const Opened<Tty> tty = Tty::open({path, 115'200});
    return tty ? "none" : tty.problem();
  }

  test::Folder folder;
  std::string path = folder.file("ttyRobot");
  FarEnd far{path};
  termios2 told_{};
};

TEST_F(TtyLine, AsksForRawLinesAtItsBaud) {
  const FakeIoctl fake(makes(9'600));
  EXPECT_EQ(set_raw_line(-1, 9'600).error, 0);
  EXPECT_EQ(told_.c_cflag, static_cast<tcflag_t>(CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT)));
  EXPECT_EQ(told_.c_ispeed, 9'600U);
  EXPECT_EQ(told_.c_ospeed, 9'600U);
  EXPECT_EQ(told_.c_cc[VMIN], 1);
  EXPECT_EQ(told_.c_cc[VTIME], 0);
  EXPECT_EQ(told_.c_iflag | told_.c_oflag | told_.c_lflag, 0U);
}

TEST_F(TtyLine, TakesABaudThatIsOffByOnePartInForty) {
  for (const std::uint32_t actual : {115'200U - 2'880U, 115'200U + 2'880U}) {
    const FakeIoctl fake(makes(actual));
    EXPECT_EQ(set_raw_line(-1, 115'200).actual_baud, 0U) << actual;
    EXPECT_EQ(problem(), "none");
  }
  for (const std::uint32_t actual : {115'200U - 2'881U, 115'200U + 2'881U, 9'600U}) {
    const FakeIoctl fake(makes(actual));
    EXPECT_EQ(set_raw_line(-1, 115'200).actual_baud, actual);
    EXPECT_EQ(problem(), "cannot set the serial port " + path + " to 115200 baud: it chose " + std::to_string(actual) +
                             "; ask for a baud that both ends can make");
  }
}

TEST_F(TtyLine, RefusesWhatIsNotEightBitsOneStopNoParity) {
  for (const int flags : {CS7, CS8 | PARENB, CS8 | CSTOPB}) {
    const FakeIoctl fake(makes(115'200, static_cast<tcflag_t>(flags)));
    EXPECT_EQ(set_raw_line(-1, 115'200).error, EINVAL) << flags;
    EXPECT_TRUE(holds(problem(), "Invalid argument; unplug it, plug it in again and look at the end of 'dmesg'"));
  }
}

TEST_F(TtyLine, SaysAtWhichCallTheDriverFailed) {
  int gets = 0;
  int failing_get = 1;
  unsigned long failing = 0;
  const FakeIoctl fake([&](unsigned long request, void*) -> std::optional<int> {
    if (request == TCGETS2) return ++gets == failing_get ? -EIO : 0;
    if (request == failing) return -EPERM;
    return 0;
  });
  EXPECT_EQ(set_raw_line(-1, 115'200).error, EIO);
  gets = 0;
  failing_get = 2;
  EXPECT_EQ(set_raw_line(-1, 115'200).error, EIO) << "asked what it made of it";
  failing = TCSETS2;
  EXPECT_EQ(set_raw_line(-1, 115'200).error, EPERM);
}

TEST_F(TtyLine, AsksForLowLatencyBesidesWhatWasSet) {
  serial_struct told{};
  int sets = 0;
  {
    const FakeIoctl fake([&](unsigned long request, void* argument) -> std::optional<int> {
      if (request == TIOCGSERIAL) static_cast<serial_struct*>(argument)->flags = ASYNC_SKIP_TEST;
      if (request != TIOCSSERIAL) return 0;
      told = *static_cast<const serial_struct*>(argument);
      return ++sets, 0;
    });
    set_low_latency(-1);
  }
  EXPECT_EQ(sets, 1);
  EXPECT_EQ(told.flags, static_cast<int>(ASYNC_SKIP_TEST | ASYNC_LOW_LATENCY));
  const FakeIoctl fake([&](unsigned long request, void*) -> std::optional<int> {
    if (request == TIOCSSERIAL) ++sets;
    return -ENOTTY;
  });
  set_low_latency(-1);
  EXPECT_EQ(sets, 1) << "an adapter without it is sent nothing";
}

TEST_F(TtyLine, IsNotForThoseWhoMayNot) {
  const FakeIoctl fake([](unsigned long request, void*) -> std::optional<int> {
    return request == TIOCEXCL ? std::optional(-EPERM) : std::nullopt;
  });
  EXPECT_TRUE(holds(problem(), "cannot open the serial port " + path));
  EXPECT_TRUE(holds(problem(), "sudo usermod -aG dialout $USER"));
}

}  // namespace
}  // namespace fencepost::linux
