#include "hal/linux/signal_flag.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>

namespace fencepost::linux {

Opened<SignalFlag> SignalFlag::open() {
  Descriptor fd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  if (!fd.open()) return failure("make", "an eventfd", errno, "close some programs, or raise 'ulimit -n'");
  return SignalFlag(std::move(fd));
}

void SignalFlag::raise() {
  const std::uint64_t one = 1;
  // Fails only when it is raised 2^64 times over.
  if (::write(fd_.get(), &one, sizeof one) < 0) return;
}

void SignalFlag::clear() {
  std::uint64_t count = 0;
  // Fails only when it is not raised.
  if (::read(fd_.get(), &count, sizeof count) < 0) return;
}

}  // namespace fencepost::linux
