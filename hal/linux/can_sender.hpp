// A CAN interface of the kernel (SocketCAN), sent on.
#pragma once

#include <string>
#include <utility>

#include "hal/base/units.hpp"
#include "hal/bus/can_bus.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::linux {

/// After the interface was down or away, `tend` finds it again by its name.
class CanSender {
 public:
  /// errors: a sentence: no such interface, it is down, a kernel without CAN.
  static Opened<CanSender> open(std::string interface);
  /// One that waits for its interface.
  static CanSender awaiting(std::string interface) { return {std::move(interface), Descriptor()}; }

  /// Into the kernel's queue; never waits. False: it was not taken, and `problem` says why.
  bool send(const bus::CanFrame& frame);
  /// Once per loop iteration; looks for a missing interface, at most every kRetryInterval.
  void tend(base::Time now);
  /// Why the last frame was not taken, or the interface is missing; empty when all is well.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  CanSender(std::string interface, Descriptor socket) : interface_(std::move(interface)), socket_(std::move(socket)) {}

  std::string interface_;
  Descriptor socket_;
  Retry retry_;
  std::string problem_;
};

}  // namespace fencepost::linux
