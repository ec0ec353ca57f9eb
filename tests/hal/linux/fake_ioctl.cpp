#include "tests/hal/linux/fake_ioctl.hpp"

#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <mutex>
#include <utility>

namespace {

std::mutex mutex;

fencepost::test::IoctlAnswer& current() {
  static auto* const answer = new fencepost::test::IoctlAnswer;
  return *answer;
}

std::optional<int> ask(unsigned long request, void* argument) {
  const std::lock_guard lock(mutex);
  return current() ? current()(request, argument) : std::nullopt;
}

}  // namespace

namespace fencepost::test {

FakeIoctl::FakeIoctl(IoctlAnswer answer) {
  const std::lock_guard lock(mutex);
  current() = std::move(answer);
}
FakeIoctl::~FakeIoctl() {
  const std::lock_guard lock(mutex);
  current() = nullptr;
}

}  // namespace fencepost::test

extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  const std::optional<int> answer = ask(request, argument);
  if (!answer) return static_cast<int>(::syscall(SYS_ioctl, fd, request, argument));
  if (*answer >= 0) return *answer;
  errno = -*answer;
  return -1;
}
