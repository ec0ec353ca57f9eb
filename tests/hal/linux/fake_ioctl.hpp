// ioctl of the test's own, for what no pseudo-terminal and no file does: the linker takes it before the C library's.
#pragma once

#include <functional>
#include <optional>

namespace fencepost::test {

/// The answer of an ioctl: 0 or more, or minus an errno. Empty: the kernel is asked.
using IoctlAnswer = std::function<std::optional<int>(unsigned long request, void* argument)>;

/// While it lives. One thread at a time may set it; any may ask.
class FakeIoctl {
 public:
  explicit FakeIoctl(IoctlAnswer answer);
  ~FakeIoctl();
  FakeIoctl(const FakeIoctl&) = delete;
  FakeIoctl& operator=(const FakeIoctl&) = delete;
};

}  // namespace fencepost::test
