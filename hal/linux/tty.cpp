#include "hal/linux/tty.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>

#include "hal/linux/tty_line.hpp"

namespace fencepost::linux {
namespace {

constexpr std::string_view kOpenTty = "open the serial port";

std::string_view tty_remedy(int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV: return "plug it in and switch it on; 'ls -l /dev/serial/by-id' lists what is there";
    case EACCES:
    case EPERM: return "add yourself to its group with 'sudo usermod -aG dialout $USER' and log in again";
    case EBUSY:
    case EWOULDBLOCK: return "another program has it; 'fuser -v' on the path names it";
    case ENOTTY: return "name a device, such as one under /dev/serial/by-id";
    default: return "unplug it, plug it in again and look at the end of 'dmesg'";
  }
}

Problem tty_problem(const std::string& path, int error) { return failure(kOpenTty, path, error, tty_remedy(error)); }

Problem wrong_baud(const TtySettings& settings, std::uint32_t actual) {
  return {"cannot set the serial port " + settings.path + " to " + std::to_string(settings.baud) + " baud: it chose " +
          std::to_string(actual) + "; ask for a baud that both ends can make"};
}

// TIOCEXCL keeps out everybody but root; the lock keeps out those who ask, root too.
int claim(int fd) {
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) return errno;
  return ::ioctl(fd, TIOCEXCL) == 0 ? 0 : errno;
}

// Nothing is flushed: a closed port hears nothing, and a pty may hold what is meant for us.
Opened<Descriptor> open_line(const TtySettings& settings) {
  Descriptor fd(::open(settings.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!fd.open()) return tty_problem(settings.path, errno == EISDIR ? ENOTTY : errno);
  if (::isatty(fd.get()) == 0) return tty_problem(settings.path, ENOTTY);
  if (const int error = claim(fd.get()); error != 0) return tty_problem(settings.path, error);
  const LineFault fault = set_raw_line(fd.get(), settings.baud);
  if (fault.error != 0) return tty_problem(settings.path, fault.error);
  if (fault.actual_baud != 0) return wrong_baud(settings, fault.actual_baud);
  set_low_latency(fd.get());
  return fd;
}

}  // namespace

Opened<Tty> Tty::open(TtySettings settings) {
  Opened<Descriptor> line = open_line(settings);
  if (!line) return Problem{line.problem()};
  return Tty(std::move(settings), std::move(*line));
}

Tty::~Tty() { release(); }

// The lock on a pty outlives the descriptor and would keep others out.
void Tty::release() {
  if (fd_.open()) ::ioctl(fd_.get(), TIOCNXCL);
  fd_.close();
}

base::Result<std::size_t> Tty::read(std::span<std::uint8_t> in) {
  if (!fd_.open()) return base::Error::kGone;
  if (in.empty()) return std::size_t{0};
  const ssize_t count = ::read(fd_.get(), in.data(), in.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return base::Error::kNotReady;
  release();
  return base::Error::kGone;
}

base::Result<std::size_t> Tty::write(std::span<const std::uint8_t> out) {
  if (!fd_.open()) return base::Error::kGone;
  if (out.empty()) return std::size_t{0};
  const ssize_t count = ::write(fd_.get(), out.data(), out.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0 || errno == EAGAIN || errno == EINTR) return base::Error::kFull;
  release();
  return base::Error::kGone;
}

void Tty::tend(base::Time now) {
  if (fd_.open() || !retry_.due(now)) return;
  Opened<Descriptor> line = open_line(settings_);
  problem_ = line ? std::string() : line.problem();
  if (line) fd_ = std::move(*line);
}

}  // namespace fencepost::linux
