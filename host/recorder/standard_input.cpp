#include "host/recorder/standard_input.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace fencepost::host {

int StandardInput::descriptor() const { return ended_ ? -1 : STDIN_FILENO; }

base::Result<std::size_t> StandardInput::read(std::span<std::uint8_t> in) {
  if (ended_) return base::Error::kGone;
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  if (::poll(&wait, 1, 0) <= 0) return base::Error::kNotReady;
  const ssize_t count = ::read(STDIN_FILENO, in.data(), in.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return base::Error::kNotReady;
  ended_ = true;
  if (count < 0) {
    problem_ = linux::failure("read", "standard input", errno, "name a port, or a file after '<'").sentence;
  }
  return base::Error::kGone;
}

}  // namespace fencepost::host
