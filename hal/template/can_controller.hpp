// A CAN controller of a board.
#pragma once

#include "hal/base/result.hpp"
#include "hal/bus/can_bus.hpp"

namespace fencepost::port {

/// Fill in: bit timing for the bus, acceptance filters for the ids that the robot's mapping names, listen-only if the
/// part can. The receive interrupt puts frames into a ring, with the clock's time of that moment in `received`.
class CanController {
 public:
  /// Fill in: the oldest frame of the ring. kBadInput, once, after an overrun or an error of the bus; kGone while the
  /// controller is bus-off. Start its recovery there, and never wait for it.
  base::Result<bus::CanFrame> receive() { return base::Error::kNotReady; }
};

static_assert(bus::CanBus<CanController>);

}  // namespace fencepost::port
