// Sleeping between inputs: the one place on Linux that waits.
#pragma once

#include <poll.h>

#include <vector>

#include "hal/base/units.hpp"
#include "hal/linux/clock.hpp"

namespace fencepost::linux {

/// After a longer delay of its inputs a program reports that its machine was busy. It is longer than a frame of most
/// cameras lasts, so blobs seen then have the wrong place.
inline constexpr base::Duration kNotedDelay = base::milliseconds(30);

/// Refilled for each wait, since descriptors come and go with their devices.
class WaitSet {
 public:
  void clear() { watched_.clear(); }
  /// Wakes when there is something to read, or the other end has gone. Below 0: passed over.
  void add_readable(int fd) { watched_.push_back({fd, POLLIN, 0}); }
  /// Wakes when something can be written; only add it if something is to be written.
  void add_writable(int fd) { watched_.push_back({fd, POLLOUT, 0}); }

  /// Sleeps until something wakes (true), the deadline has passed, or a signal came (false).
  bool wait_until(const MonotonicClock& clock, base::Time deadline);

 private:
  std::vector<pollfd> watched_;
};

}  // namespace fencepost::linux
