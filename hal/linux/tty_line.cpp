#include "hal/linux/tty_line.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <linux/serial.h>
#include <linux/tty_flags.h>
#include <sys/ioctl.h>

#include <cerrno>

namespace fencepost::linux {
namespace {

// A receiver samples each bit of ten in its middle: 5 % loses the last one, and the other end is off as well.
constexpr std::uint32_t kBaudTolerance = 40;  ///< one part in

bool near(std::uint32_t actual, std::uint32_t wanted) {
  const std::uint32_t off = actual > wanted ? actual - wanted : wanted - actual;
  return off <= wanted / kBaudTolerance;
}

}  // namespace

LineFault set_raw_line(int fd, std::uint32_t baud) {
  termios2 line{};
  if (::ioctl(fd, TCGETS2, &line) != 0) return {errno, 0};
  line.c_iflag = 0;
  line.c_oflag = 0;
  line.c_lflag = 0;
  line.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
  line.c_ispeed = baud;
  line.c_ospeed = baud;
  // With 0 a read of an empty line would answer 0 bytes, as one of a hung-up line does.
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  if (::ioctl(fd, TCSETS2, &line) != 0) return {errno, 0};
  // A driver that cannot do as asked does something else and says so only here.
  if (::ioctl(fd, TCGETS2, &line) != 0) return {errno, 0};
  if (!near(line.c_ospeed, baud)) return {0, line.c_ospeed};
  return {(line.c_cflag & (CSIZE | PARENB | CSTOPB)) == CS8 ? 0 : EINVAL, 0};
}

void set_low_latency(int fd) {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return;
  serial.flags = static_cast<int>(static_cast<unsigned>(serial.flags) | ASYNC_LOW_LATENCY);
  ::ioctl(fd, TIOCSSERIAL, &serial);
}

}  // namespace fencepost::linux
