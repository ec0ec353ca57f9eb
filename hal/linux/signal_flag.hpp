// How a thread wakes the loop: a flag that poll(2) can see (eventfd).
#pragma once

#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"

namespace fencepost::linux {

class SignalFlag {
 public:
  static Opened<SignalFlag> open();
  void raise();
  void clear();
  /// Readable while raised.
  [[nodiscard]] int descriptor() const { return fd_.get(); }

 private:
  explicit SignalFlag(Descriptor fd) : fd_(std::move(fd)) {}
  Descriptor fd_;
};

}  // namespace fencepost::linux
