// libusb without USB: one present device that accepts transfers and completes none; and the hangs of the real library.
#pragma once

#include <atomic>

namespace fencepost::test {

/// Each may be set and cleared at any time; a call that waits in there continues when it is cleared.
struct FakeLibusb {
  std::atomic<bool> hang_in_open = false;
  std::atomic<bool> hang_in_exit = false;
  std::atomic<bool> keep_transfers = false;  ///< a cancelled one is not given back
  std::atomic<bool> unplugged = false;       ///< transfers end, where they are not kept
  std::atomic<int> contexts = 0;             ///< that are not closed
  std::atomic<int> handles = 0;
  std::atomic<int> transfers = 0;  ///< allocated
  std::atomic<int> in_flight = 0;
};

FakeLibusb& fake_libusb();

}  // namespace fencepost::test
