// A CAN interface of the kernel (SocketCAN), listened to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/can_bus.hpp"
#include "hal/linux/clock.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::linux {

/// Lets through frames whose id equals `id` in the bits of `mask`, of one kind only.
struct CanFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0x1FFF'FFFF;
  bool extended = false;
};

struct CanSettings {
  std::string interface;           ///< such as can0
  std::vector<CanFilter> filters;  ///< a frame passes if any lets it through; none: every frame
};

/// Frames carry the time of the kernel that took them in, by `clock`. After the interface was down or away, `tend`
/// finds it again by its name. Frames that the kernel had no room for are answered as one kBadInput.
class Can {
 public:
  /// errors: a sentence: no such interface, it is down, a kernel without CAN.
  static Opened<Can> open(CanSettings settings, MonotonicClock clock);

  base::Result<bus::CanFrame> receive();

  /// Once per loop iteration; looks for a missing interface, at most every kRetryInterval.
  void tend(base::Time now);
  /// False while the interface is down or away, or its controller is bus-off.
  [[nodiscard]] bool connected() const { return socket_.open() && !bus_off_; }
  /// Why the last try to open it again failed; empty when none did.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// For WaitSet; -1 while the interface is down.
  [[nodiscard]] int descriptor() const { return socket_.get(); }

 private:
  Can(CanSettings settings, MonotonicClock clock, Descriptor socket)
      : settings_(std::move(settings)), clock_(clock), socket_(std::move(socket)) {}
  base::Result<bus::CanFrame> take_error_frame(std::uint32_t what);
  base::Result<bus::CanFrame> fail(int error);

  CanSettings settings_;
  MonotonicClock clock_;
  Descriptor socket_;
  Retry retry_;
  std::string problem_;
  bool bus_off_ = false;
  bool down_ = false;                  ///< the interface; frames from before are still to be read
  std::uint32_t lost_ = 0;             ///< frames that the socket had no room for, since it was opened
  std::optional<bus::CanFrame> held_;  ///< arrived with a reported loss; the loss is returned first
};

static_assert(bus::CanBus<Can>);

}  // namespace fencepost::linux
