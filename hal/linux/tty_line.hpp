// The line settings of a serial port. Apart from tty.cpp, because the kernel's termios2 and the C library's termios
// cannot be included together.
#pragma once

#include <cstdint>

namespace fencepost::linux {

/// Failures of `set_raw_line`.
struct LineFault {
  int error = 0;                  ///< errno; 0: none
  std::uint32_t actual_baud = 0;  ///< the port's choice instead of the baud asked for; 0: as asked
};

/// Raw, 8N1, no flow control, modem lines ignored, at any baud the port can make (BOTHER, ioctl_tty(2)).
LineFault set_raw_line(int fd, std::uint32_t baud);

/// Asks the driver to hand over each byte at once (ASYNC_LOW_LATENCY). Many have nothing to set: no error.
void set_low_latency(int fd);

}  // namespace fencepost::linux
